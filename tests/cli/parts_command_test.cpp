/// Programs for controllers that take so many lines.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

TEST(PartsCommand, ThePartsLeaveWhatTheWholeLeaves) {
  const SmallInputs inputs;
  const test::Words usual{"--map-pixel", "0.5,0.4", "--max-feed", "600", "--max-lines", "100", "--zero", "2,-1"};
  const ProgramResult plan = inputs.run(SmallInputs::plan(usual));
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  const json summary = json::parse(read_whole_file(inputs / "plan/summary.json"));
  ASSERT_EQ(summary["exports"].size(), 1U);
  const json& parts = summary["exports"][0];
  EXPECT_EQ(parts["format"], "parts");
  EXPECT_EQ(parts["file"], "program_parts.csv");
  const int files = parts["files"];
  EXPECT_GE(files, 3);
  const std::string last = "plan/program_00" + std::to_string(files - 1) + ".nc";
  const std::string text = read_whole_file(inputs / last);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 100);
  expect_has(plan.out, "program_parts.csv and ");
  const auto left_by = [&inputs](const std::string& file) {
    const ProgramResult result = inputs.run({"simulate", "--program", file, "--map", "map.csv", "--map-pixel",
                                             "0.5,0.4", "--tif", "tif.csv", "--tif-pixel", "0.5", "--exact", "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out)["program"];
  };
  const json whole = left_by("plan/program.nc"), together = left_by("plan/program_parts.csv");
  EXPECT_EQ(together["residual_rms_nm"], whole["residual_rms_nm"]);
  // Ten millimetres up and ten down at 10 mm/s for each cut.
  EXPECT_NEAR(together["total_s"].get<double>(), whole["total_s"].get<double>() + 2.0 * (files - 2), 1e-6);
  // One changed file is another program.
  inputs.folder.file(last, text + "\n");
  const ProgramResult changed = inputs.run({"simulate", "--program", "plan/program_parts.csv", "--map", "map.csv",
                                            "--map-pixel", "0.5,0.4", "--tif", "tif.csv", "--tif-pixel", "0.5"});
  EXPECT_EQ(changed.exit_code, 2);
  expect_has(changed.err, "required the file that the list was made with");
  // The next plan takes their place; one that is short enough has none.
  EXPECT_EQ(inputs.run(SmallInputs::plan({"--max-lines", "100000"})).exit_code, 0);
  EXPECT_FALSE(test::names_in(inputs / "plan").contains("program_001.nc"));
  EXPECT_EQ(inputs.run(SmallInputs::plan({"--max-lines", "20"})).exit_code, 2);
}

TEST(PartsCommand, TheirStopsAreInWhatTheyLeaveOnAMachine) {
  const SmallInputs inputs;
  inputs.folder.file("m.toml", "max_feed_mm_per_min = 3000\npath_acceleration_mm_per_s2 = 100\n");
  const ProgramResult plan = inputs.run(
      SmallInputs::plan({"--map-pixel", "0.5,0.4", "--max-feed", "600", "--max-lines", "100", "--machine", "m.toml"}));
  ASSERT_TRUE(plan.exit_code == 0 || plan.exit_code == 3) << plan.err;
  const json summary = json::parse(read_whole_file(inputs / "plan/summary.json"));
  const json& parts = summary["exports"][0];
  const ProgramResult simulated =
      inputs.run({"simulate", "--program", "plan/program_parts.csv", "--map", "map.csv", "--map-pixel", "0.5,0.4",
                  "--tif", "tif.csv", "--tif-pixel", "0.5", "--machine", "m.toml", "--json"});
  const json found = json::parse(simulated.out);
  EXPECT_NEAR(found["program"]["residual_rms_nm"].get<double>(), parts["rms_nm"].get<double>(),
              1e-3 * parts["rms_nm"].get<double>());
  EXPECT_EQ(plan.exit_code == 3, !summary["limits"].empty());
}

}  // namespace
}  // namespace dwell
