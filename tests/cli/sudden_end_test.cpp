#include <gtest/gtest.h>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using test::expect_has;
using test::names_in;
using test::SmallInputs;

/// What is in the inputs' folder but for what the last command said.
std::set<std::string> names_of(const SmallInputs& inputs) {
  std::set<std::string> names = names_in(inputs.folder.path());
  names.erase("said.txt");
  return names;
}

TEST(SuddenEnd, OfAKilledPlanIsClearedByTheNext) {
  const SmallInputs inputs;
  auto expected = names_of(inputs);
  const auto run = inputs.start_long_plan();
  ASSERT_FALSE(run->ended()) << run->err();
  run->signal(SIGKILL);
  run->wait();
  inputs.remove_long_plan();
  ASSERT_EQ(names_of(inputs).size(), expected.size() + 1);  // the unfinished folder: nobody could remove it
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  expected.insert("plan");
  EXPECT_EQ(names_of(inputs), expected);
}

TEST(SuddenEnd, ByALimitOfTheSizeOfFilesIsAFailedWrite) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.exit_of("map map.csv --map-pixel 0.5 --write a.npy"), 0);
  const std::string array = read_whole_file(inputs / "a.npy"), sidecar = read_whole_file(inputs / "a.npy.json");
  const auto before = names_of(inputs);
  const std::string limit = "ulimit -f 1; ";  // of 512 bytes or of 1024
  EXPECT_EQ(inputs.exit_of("map map.csv --map-pixel 0.5 --step flip:x --write a.npy", limit), 2);
  expect_has(read_whole_file(inputs / "said.txt"), "a.npy': File too large");
  EXPECT_EQ(inputs.exit_of(SmallInputs::plan_for_shell(), limit), 2);
  expect_has(read_whole_file(inputs / "said.txt"), "File too large");
  EXPECT_EQ(names_of(inputs), before);
  EXPECT_EQ(read_whole_file(inputs / "a.npy"), array);
  EXPECT_EQ(read_whole_file(inputs / "a.npy.json"), sidecar);
}

/// The OpenMP library ends the process itself where a thread cannot be started: here for want of room for its stack.
TEST(SuddenEnd, WhereNoThreadCanBeStartedLeavesNothing) {
  const SmallInputs inputs;
  const auto before = names_of(inputs);
  EXPECT_EQ(inputs.exit_of(SmallInputs::plan_for_shell({"--threads", "4"}), "export OMP_STACKSIZE=100000G; "), 1);
  expect_has(read_whole_file(inputs / "said.txt"), "hread");
  EXPECT_EQ(names_of(inputs), before);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(SuddenEnd, OutOfMemoryIsAFaultWithWords) {
  const SmallInputs inputs;
  const auto before = names_of(inputs);
  const std::string limit = "ulimit -v 1000000; ";  // KiB
  const std::string plan = SmallInputs::plan_for_shell({"--path", "raster:pitch=0.003,overrun=2,angle=3"});
  EXPECT_EQ(inputs.exit_of(plan, limit), 1);
  const std::string said = read_whole_file(inputs / "said.txt");
  expect_has(said, "memory");
  expect_has(said, "GiB are to be had");
  EXPECT_EQ(names_of(inputs), before);
}
#endif

}  // namespace
}  // namespace dwell
