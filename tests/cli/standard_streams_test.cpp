#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "core/base/utf8_text.h"
#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using test::expect_has;
using test::SmallInputs;

TEST(StandardStreams, AnswerThatCannotBeWrittenIsAFault) {
  const SmallInputs inputs;
  for (const char* words : {"map map.csv --map-pixel 0.5", "map map.csv --map-pixel 0.5 --json", "--help", "--version",
                            "plan --map map.csv --tif tif.csv --path raster:pitch=1 --write-job", "map --steps"}) {
    EXPECT_EQ(inputs.exit_of(std::string(words) + " >/dev/full"), 1) << words;
    expect_has(read_whole_file(inputs / "said.txt"), "cannot write the answer to standard output");
    EXPECT_EQ(inputs.exit_of(std::string(words) + " >&-"), 1) << words;
    expect_has(read_whole_file(inputs / "said.txt"), "cannot write the answer to standard output");
    EXPECT_EQ(inputs.exit_of(std::string(words) + " >/dev/null"), 0) << words;
  }
}

TEST(StandardStreams, ThatAreClosedTakeNothingFromTheFilesThatAreWritten) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.exit_of("map map.csv --map-pixel 0.5 --write a.npy"), 0);
  EXPECT_EQ(inputs.exit_of("map map.csv --map-pixel 0.5 --write b.npy <&- >&- 2>&-"), 1);
  EXPECT_EQ(read_whole_file(inputs / "b.npy"), read_whole_file(inputs / "a.npy"));
  // A fault that nobody reads of is still told by the exit code.
  EXPECT_EQ(inputs.exit_of("map none.csv --map-pixel 0.5 2>&-"), 2);
}

TEST(StandardStreams, ShowBytesThatAreNoUtf8Escaped) {
  const SmallInputs inputs;
  std::filesystem::rename(inputs / "map.csv", inputs / "m\xE9.csv");
  const test::ProgramResult read = inputs.run({"map", "m\xE9.csv", "--map-pixel", "0.5"});
  EXPECT_EQ(read.exit_code, 0);
  expect_has(read.out, "file      m\\xE9.csv");
  EXPECT_TRUE(is_utf8(read.out));
  const test::ProgramResult refused = inputs.run({"map", "n\xE9.csv", "--map-pixel", "0.5"});
  EXPECT_EQ(refused.exit_code, 2);
  expect_has(refused.err, "cannot read 'n\\xE9.csv'");
}

TEST(StandardStreams, InterruptAtTheVeryBeginningIsSaid) {
  const SmallInputs inputs;
  const std::string said = inputs / "said.txt", program = DWELL_PROGRAM;
  std::vector<std::string> words = SmallInputs::plan();
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {  // the interrupt is there before the program is
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigprocmask(SIG_BLOCK, &set, nullptr);
    raise(SIGINT);
    if (!freopen(said.c_str(), "w", stderr)) _exit(99);
    if (chdir(inputs.folder.path().c_str()) != 0) _exit(97);
    execv(program.c_str(), arguments.data());
    _exit(98);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130) << status;
  expect_has(read_whole_file(said), "dwell: interrupted; nothing was written");
}

TEST(StandardStreams, ThatNobodyReadsEndNothing) {
  const SmallInputs inputs;
  const auto before = test::names_in(inputs.folder.path());
  std::string words;
  for (const std::string& word : SmallInputs::plan()) words += "'" + word + "' ";
  // The reader of both streams is gone at once.
  inputs.exit_of("--version; ('" DWELL_PROGRAM "' " + words + "; echo $? >code.txt) 2>&1 | true; sleep 0.1");
  for (int k = 0; k < 200 && !std::filesystem::exists(inputs / "code.txt"); ++k) usleep(50'000);
  std::set<std::string> after = test::names_in(inputs.folder.path());
  EXPECT_EQ(read_whole_file(inputs / "code.txt"), "1\n");  // the plan is there, the answer is lost
  EXPECT_EQ(after.erase("plan"), 1u);
  after.erase("code.txt");
  after.erase("said.txt");
  EXPECT_EQ(after, before);
}

TEST(StandardStreams, HangUpEndsACommandAsAnInterruptDoes) {
  const SmallInputs inputs;
  const auto before = test::names_in(inputs.folder.path());
  const auto run = inputs.start_long_plan();
  ASSERT_FALSE(run->ended()) << run->err();
  run->signal(SIGHUP);
  EXPECT_EQ(run->wait().exit_code, 130);
  inputs.remove_long_plan();
  EXPECT_EQ(test::names_in(inputs.folder.path()), before);
}

}  // namespace
}  // namespace dwell
