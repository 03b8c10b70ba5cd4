/// dwell plan --resume: the rest of a program that was stopped, by its line.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

TEST(ResumeCommand, WritesTheRestAndSaysWhatWasRemoved) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan({"--block-numbers", "10", "--accept", "rms<=1um"})).exit_code, 0);
  const ProgramResult rest = inputs.run({"plan", "--resume", "200", "--log-plan", "plan", "--out", "rest"});
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  expect_has(rest.out, "resume    plan stopped by line 200 of program.nc: in step ");
  expect_has(rest.out, "removed so far: ");
  expect_has(rest.out, "warning   where the program stopped is uncertain by a block");
  expect_has(rest.out, "accept    rms ");
  expect_has(read_whole_file(inputs / "rest/program.nc"), "\nN10 ");
  const json whole = json::parse(read_whole_file(inputs / "plan/summary.json"));
  const json summary = json::parse(read_whole_file(inputs / "rest/summary.json"));
  EXPECT_EQ(summary["options"]["map"], "rest/remaining.npy");
  EXPECT_NEAR(summary["program"]["residual_rms_nm"].get<double>(), whole["program"]["residual_rms_nm"].get<double>(),
              0.05 * whole["program"]["residual_rms_nm"].get<double>());
  const ProgramResult simulated = inputs.run({"simulate", "rest", "--json"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_NEAR(json::parse(simulated.out)["program"]["residual_rms_nm"].get<double>(),
              summary["program"]["residual_rms_nm"].get<double>(), 1e-6);
  // It replaces itself as any plan does.
  EXPECT_EQ(inputs.run({"plan", "--resume", "230", "--log-plan", "plan", "--out", "rest"}).exit_code, 0);
}

TEST(ResumeCommand, RefusesOtherOptionsByTheirFlags) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
    std::vector<std::string> all{"plan", "--resume"};
    all.insert(all.end(), more.begin(), more.end());
    const ProgramResult result = inputs.run(all);
    EXPECT_EQ(result.exit_code, 2) << words;
    expect_has(result.err, words);
  };
  refused({"200", "--log-plan", "plan", "--out", "rest", "--smoothness", "1"}, "--smoothness: not with --resume");
  refused({"200", "--log-plan", "plan", "--out", "rest", "--map", "map.csv"}, "--map: not with --resume");
  refused({"2", "--log-plan", "plan", "--out", "rest"}, "--resume = 2: plan/program.nc: lies before the work");
  refused({"200", "--out", "rest"}, "--resume = 200: required --log-plan beside it");
  refused({"200", "--log-plan", "plan", "--out", "plan"}, "summary.json");
  refused({"nowhere.csv", "--log-plan", "plan", "--out", "rest"}, "nowhere.csv");
  EXPECT_FALSE(std::filesystem::exists(inputs / "rest"));
}

}  // namespace
}  // namespace dwell
