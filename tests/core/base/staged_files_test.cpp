#include "core/base/staged_files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <string>

#include "core/base/errors.h"
#include "core/base/whole_file.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

using test::TemporaryFolder;

TEST(StagedFiles, AppearTogether) {
  const TemporaryFolder folder;
  folder.file("b", "earlier");
  StagedFiles files;
  files.add(folder.path() / "a", "one");
  files.add(folder.path() / "b", "two");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a"));
  EXPECT_EQ(read_whole_file(folder.path() / "b"), "earlier");
  files.put_in_place();
  EXPECT_EQ(read_whole_file(folder.path() / "a"), "one");
  EXPECT_EQ(read_whole_file(folder.path() / "b"), "two");
  EXPECT_EQ(folder.entries(), 2u);
}

/// As a full disk does, a limit of the size of files makes the second of two fail.
TEST(StagedFiles, LeaveNothingWhereOneCannotBeWritten) {
  const TemporaryFolder folder;
  folder.file("a", "earlier");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  test::expect_input_error(
      [&] {
        StagedFiles files;
        files.add(folder.path() / "a", "small");
        files.add(folder.path() / "b", std::string(5000, 'x'));
        files.put_in_place();
      },
      {"cannot write", (folder.path() / "b").string(), "File too large"});
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(read_whole_file(folder.path() / "a"), "earlier");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(StagedFiles, ThatAreNotPutInPlaceLeaveNothing) {
  const TemporaryFolder folder;
  {
    StagedFiles files;
    files.add(folder.path() / "a", "one");
  }
  EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace dwell
