#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>
#include <string>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

const char* const kMachine = "max_feed_mm_per_min = 3000\npath_acceleration_mm_per_s2 = 100\n";

TEST(ExportCommand, WritesEveryFormatAndReadsEachBack) {
  const SmallInputs inputs;
  inputs.folder.file("m.toml", kMachine);
  const ProgramResult plan = inputs.run(SmallInputs::plan(
      {"--machine", "m.toml", "--max-feed", "600", "--export", "g293,pmac,xps-trj,pvt-hdf5,pvt-json,pvt-csv"}));
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  expect_has(plan.out, "export    pvt.csv: RMS ");
  expect_has(plan.out, "xps.csv and 1 file: RMS ");
  const json summary = json::parse(read_whole_file(inputs / "plan/summary.json"));
  ASSERT_EQ(summary["exports"].size(), 6U);
  EXPECT_EQ(summary["options"]["export"], "pvt-csv,pvt-json,pvt-hdf5,xps-trj,pmac,g293");
  const double planned = summary["program"]["residual_rms_nm"];
  const auto names = test::names_in(inputs / "plan");
  for (const json& written : summary["exports"]) {
    const std::string file = written["file"];
    EXPECT_NEAR(written["rms_nm"].get<double>(), planned, 0.01 * planned) << file;
    EXPECT_EQ(written["sha256"], sha256_of_file(inputs / ("plan/" + file)));
    EXPECT_TRUE(names.contains(file)) << file;
    const ProgramResult simulated =
        inputs.run({"simulate", "--program", "plan/" + file, "--map", "map.csv", "--map-pixel", "0.5", "--tif",
                    "tif.csv", "--tif-pixel", "0.5", "--machine", "m.toml", "--json"});
    ASSERT_EQ(simulated.exit_code, 0) << file << simulated.err;
    const json found = json::parse(simulated.out);
    EXPECT_NEAR(found["program"]["residual_rms_nm"].get<double>(), written["rms_nm"].get<double>(), 1e-3 * planned)
        << file;
    EXPECT_NEAR(found["program"]["total_s"].get<double>(), written["total_s"].get<double>(), 1e-6) << file;
  }
  // A stretch alone says no beginning; the list does, and another map is refused by what it says of the plan's.
  const std::vector<std::string> stretch{
      "simulate", "--program", "plan/program_001.trj", "--map", "map.csv", "--map-pixel", "0.5",
      "--tif",    "tif.csv",   "--tif-pixel",          "0.5"};
  const ProgramResult without = inputs.run(stretch);
  EXPECT_EQ(without.exit_code, 2);
  expect_has(without.err, "required --start X,Y in mm");
  EXPECT_EQ(inputs.run(test::with(stretch, {"--start", "-2,0"})).exit_code, 0);
  EXPECT_EQ(inputs.run(test::with(stretch, {"--start", "-2"})).exit_code, 2);
  for (const char* file : {"plan/pvt.csv", "plan/pvt.json", "plan/xps.csv", "plan/g293.nc"}) {
    const ProgramResult other = inputs.run({"simulate", "--program", file, "--map", "tif.csv", "--map-pixel", "0.5",
                                            "--tif", "tif.csv", "--tif-pixel", "0.5"});
    EXPECT_EQ(other.exit_code, 2) << file;
    expect_has(other.err, "--other-map");
  }
  // The next plan without exports takes the place of this one.
  EXPECT_EQ(inputs.run(SmallInputs::plan()).exit_code, 0);
  EXPECT_FALSE(test::names_in(inputs / "plan").contains("program_001.trj"));
}

TEST(ExportCommand, SaysWhatItNeeds) {
  const SmallInputs inputs;
  inputs.folder.file("m.toml", kMachine);
  inputs.folder.file("free.toml", std::string(kMachine) + "[corner]\nrule = \"free\"\n");
  inputs.folder.file("any.toml", "max_feed_mm_per_min = 3000\n[x]\nmax_acceleration_mm_per_s2 = 100\n");
  const auto refused = [&inputs](const std::vector<std::string>& more, const std::string& says) {
    const ProgramResult result = inputs.run(SmallInputs::plan(more));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    expect_has(result.err, says);
  };
  refused({"--export", "pvt-csv"},
          "--export = pvt-csv: such a program is the motion of a machine; required a --machine");
  refused({"--export", "csv"}, "accepted: pvt-csv, pvt-json, pvt-hdf5, xps-trj, pmac, g293, flin");
  refused({"--export", "pmac", "--machine", "free.toml"}, "--export: the --machine has the corner rule free");
  refused({"--export", "pmac", "--machine", "any.toml"}, "has no limit of acceleration along y");
  EXPECT_EQ(inputs.run(SmallInputs::plan({"--export", "none"})).exit_code, 0);
  inputs.folder.file("blocks.toml", std::string(kMachine) + "[controller]\nmax_blocks_per_s = 100\n");
  inputs.folder.file("head.txt", "M8\n");
  refused(
      {"--export", "g293", "--machine", "m.toml", "--schedule", "pvt"},
      "--schedule = pvt: rounds corners on cubics, which the feeds of --export = g293 cannot say; accepted: linear");
  refused({"--export", "g293", "--machine", "m.toml", "--units", "inch"},
          "--units = inch: programs of --export = g293");
  refused({"--export", "flin", "--machine", "m.toml"}, "--schedule = constant: with one feed a stroke --export = flin");
  refused({"--export", "g293", "--machine", "m.toml", "--header", "head.txt"}, "--header: its lines are plain G-code");
  refused({"--export", "flin", "--machine", "blocks.toml", "--schedule", "linear"},
          "--export = flin: the --machine has [controller] limits");
  refused({"--export", "g293,pmac", "--machine", "m.toml", "--rotate", "30"}, "places in such a program are those of");
  // The comparison of paths writes plans, too.
  const std::vector<std::string> paths{"paths",          "--map",       "map.csv",  "--map-pixel", "0.5",    "--tif",
                                       "tif.csv",        "--tif-pixel", "0.5",      "--threads",   "1",      "--paths",
                                       "raster:pitch=2", "--out",       "compared", "--export",    "pvt-csv"};
  EXPECT_EQ(inputs.run(paths).exit_code, 2);
  EXPECT_EQ(inputs.run(test::with(paths, {"--machine", "m.toml", "--time-price", "0"})).exit_code, 0);
}

/// The speeds of a schedule, in the machine's frame, in a file that leaves what the plan says.
TEST(ExportCommand, WritesFeedsAtTheEndsOfBlocksInTheMachinesFrame) {
  const SmallInputs inputs;
  inputs.folder.file("m.toml", std::string(kMachine) + "[y]\nmax_acceleration_mm_per_s2 = 60\nletter = \"V\"\n");
  for (const char* word : {"g293", "flin"}) {
    const ProgramResult plan =
        inputs.run(SmallInputs::plan({"--machine", "m.toml", "--max-feed", "600", "--schedule", "linear", "--export",
                                      word, "--zero", "3,-2", "--rotate", "30", "--swap-axes", "--block-numbers"}));
    ASSERT_EQ(plan.exit_code, 0) << plan.err;
    const json summary = json::parse(read_whole_file(inputs / "plan/summary.json"));
    ASSERT_EQ(summary["exports"].size(), 1U);
    EXPECT_EQ(summary["exports"][0]["rms_nm"], summary["program"]["residual_rms_nm"]);
    EXPECT_TRUE(summary["limits"].empty()) << summary["limits"];
    const ProgramResult simulated = inputs.run({"simulate", "plan", "--json"});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
    const json found = json::parse(simulated.out);
    EXPECT_NEAR(found["program"]["residual_rms_nm"].get<double>(), summary["program"]["residual_rms_nm"].get<double>(),
                1e-9);
    EXPECT_NEAR(found["program"]["total_s"].get<double>(), summary["program"]["total_s"].get<double>(), 1e-6);
    EXPECT_NEAR(summary["exports"][0]["total_s"].get<double>(), summary["program"]["total_s"].get<double>(), 1e-6);
  }
}

}  // namespace
}  // namespace dwell
