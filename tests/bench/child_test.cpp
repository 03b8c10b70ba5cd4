#include "bench/child.h"

#include <gmock/gmock.h>

#include "bench/scratch_folder.h"
#include "core/base/whole_file.h"

namespace dwell::bench {
namespace {

TEST(Child, SaysHowItEnded) {
  EXPECT_EQ(run_program("/bin/sh", {"-c", "exit 0"}, {}).end, ChildEnd::Done);
  const ChildRun failed = run_program("/bin/sh", {"-c", "exit 3"}, {});
  EXPECT_EQ(failed.end, ChildEnd::Failed);
  EXPECT_EQ(failed.exit_code, 3);
  ChildOptions short_limit;
  short_limit.limit = 1.0;
  EXPECT_EQ(run_program("/bin/sleep", {"60"}, short_limit).end, ChildEnd::Killed);
}

TEST(Child, IsInterruptedInTimeUnlessItEndsBefore) {
  ChildOptions how;
  how.interrupt_after = 0.2;
  const ChildRun run = run_program("/bin/sleep", {"60"}, how);
  EXPECT_GT(run.interrupted_seconds, 0.0);
  EXPECT_NE(run.end, ChildEnd::Done);
  how.interrupt_after = 60.0;
  const ChildRun before = run_program("/bin/sh", {"-c", "exit 0"}, how);
  EXPECT_EQ(before.interrupted_seconds, 0.0);
  EXPECT_EQ(before.end, ChildEnd::Done);
}

TEST(Child, WritesWhatItSaysAndMakesScratchFoldersWhereItIsTold) {
  const ScratchFolder folder;
  ChildOptions how;
  how.output = folder.path() / "words.txt";
  how.scratch = folder.path();
  EXPECT_EQ(run_program("/bin/sh", {"-c", "echo first; echo $TMPDIR"}, how).end, ChildEnd::Done);
  EXPECT_EQ(last_line_of(how.output), folder.path().string());
  EXPECT_EQ(last_line_of(folder.path() / "none.txt"), "");
}

}  // namespace
}  // namespace dwell::bench
