#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

constexpr const char* kJob =
    "map = 'map.csv'\nmap_pixel_mm = 0.5\ntif = 'tif.csv'\ntif_pixel_mm = 0.5\nthreads = 1\n"
    "path = 'raster:pitch=1,overrun=2'\ntime_price_nm2_per_s = 0\nsmoothness = 0.1\n";
constexpr const char* kFields =
    "[machine]\nname = \"in the job\"\npath_acceleration_mm_per_s2 = 40\nmax_feed_mm_per_min = 600\n[machine.lift]\n"
    "settle_s = 0.2\n[machine.x]\nletter = \"U\"\n";

// A plan whose machine stands in the job is that of the machine's file, and its folder knows the machine.
TEST(InlineMachine, PlansAsAFileDoesAndRunsAgain) {
  const SmallInputs inputs;
  inputs.folder.file("job.toml", std::string(kJob) + kFields);
  const ProgramResult plan = inputs.run({"plan", "--job", "job.toml", "--out", "a", "--json"});
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  const json summary = json::parse(plan.out);
  EXPECT_EQ(summary["machine"]["name"], "in the job");
  EXPECT_EQ(summary["machine"]["lift_settle_s"], 0.2);
  EXPECT_EQ(summary["machine"]["x_letter"], "U");
  expect_has(summary["options"]["machine"], "path_acceleration_mm_per_s2 = 40");
  for (const json& input : summary["inputs"]) EXPECT_NE(input["role"], "machine");
  inputs.folder.file("m.toml",
                     "name = \"in the job\"\npath_acceleration_mm_per_s2 = 40\nmax_feed_mm_per_min = 600\n"
                     "[lift]\nsettle_s = 0.2\n[x]\nletter = \"U\"\n");
  inputs.folder.file("other.toml", std::string(kJob) + "machine = 'm.toml'\n");
  const ProgramResult other = inputs.run({"plan", "--job", "other.toml", "--out", "b", "--json"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  const json by_file = json::parse(other.out);
  EXPECT_EQ(by_file["program"]["residual_rms_nm"], summary["program"]["residual_rms_nm"]);
  EXPECT_EQ(by_file["total_s"], summary["total_s"]);
  EXPECT_EQ(by_file["machine"], summary["machine"]);
  const ProgramResult again = inputs.run({"simulate", "a", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NEAR(json::parse(again.out)["executed"]["total_s"].get<double>(), summary["total_s"].get<double>(), 1e-6);
  // The job that the program writes of it, and one on the command line.
  const ProgramResult job = inputs.run({"plan", "--job", "job.toml", "--out", "c", "--write-job"});
  ASSERT_EQ(job.exit_code, 0) << job.err;
  inputs.folder.file("written.toml", job.out);
  const ProgramResult written = inputs.run({"plan", "--job", "written.toml", "--json"});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(json::parse(written.out)["program"]["sha256"], summary["program"]["sha256"]);
  const ProgramResult none = inputs.run({"plan", "--job", "job.toml", "--out", "d", "--machine", "none", "--json"});
  ASSERT_EQ(none.exit_code, 0) << none.err;
  EXPECT_FALSE(json::parse(none.out).contains("machine"));
}

TEST(InlineMachine, IsRefusedBesideAFileAndByItsFields) {
  const SmallInputs inputs;
  inputs.folder.file("both.toml", std::string(kJob) + "machine = 'm.toml'\n" + kFields);
  const ProgramResult both = inputs.run({"plan", "--job", "both.toml", "--out", "a"});
  EXPECT_EQ(both.exit_code, 2);
  expect_has(both.err, "both.toml: line 10");
  expect_has(both.err, "machine");
  inputs.folder.file("wrong.toml", std::string(kJob) + "[machine.corner]\ndelay = 3\n");
  const ProgramResult wrong = inputs.run({"plan", "--job", "wrong.toml", "--out", "a"});
  EXPECT_EQ(wrong.exit_code, 2);
  expect_has(wrong.err, "wrong.toml: machine: line 10: corner.delay: unknown field; accepted in [corner]: rule, ");
  const ProgramResult option = inputs.run(SmallInputs::plan({"--machine", "{ max_feed_mm_per_min = -3 }"}));
  EXPECT_EQ(option.exit_code, 2);
  expect_has(option.err, "--machine: the fields: max_feed_mm_per_min = -3; required a finite number > 0");
}

}  // namespace
}  // namespace dwell
