/// Programs by templates, from the plan to what their files leave.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

#include "core/base/whole_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::Words;

const char* const kLimits = "max_feed_mm_per_min = 3000\npath_acceleration_mm_per_s2 = 100\n";

/// A plan of a part with pixels that are not square.
Words plan_words(const Words& more) {
  return SmallInputs::plan(test::with({"--map-pixel", "0.5,0.4", "--max-feed", "600"}, more));
}

Words simulate_words(const std::string& file, const Words& more) {
  return test::with({"simulate", "--program", file, "--map", "map.csv", "--map-pixel", "0.5,0.4", "--tif", "tif.csv",
                     "--tif-pixel", "0.5", "--json"},
                    more);
}

struct TemplateCase {
  std::string name, file;
  Words plan;
  double within;  // of the residual that program.nc, or the exported table, leaves
};

TEST(TemplateCommand, EveryShippedOneGoesFromPlanToFileAndBack) {
  const SmallInputs inputs;
  inputs.folder.file("m.toml", kLimits);
  const Words machine{"--machine", "m.toml"}, once = test::with(machine, {"--rounds", "1"});
  for (const TemplateCase& c :
       {TemplateCase{"siemens-840d", "program_by_template.mpf", {}, 1e-6},
        TemplateCase{"siemens-840d", "program_by_template.mpf", machine, 1e-6},
        TemplateCase{"fanuc", "program_by_template.tap", {}, 1e-3},
        TemplateCase{"aerotech-a3200", "program_by_template.pgm", test::with(once, {"--export", "pvt-csv"}), 1e-6},
        TemplateCase{"aerotech-a3200", "program_by_template.pgm", test::with(once, {"--schedule", "linear"}), 1e-6},
        TemplateCase{"galil", "program_by_template.dmc", machine, 5e-3},
        TemplateCase{"galil", "program_by_template.dmc", test::with(once, {"--schedule", "pvt"}), 2e-2}}) {
    SCOPED_TRACE(c.name + (c.plan.empty() ? "" : " " + c.plan.back()));
    const ProgramResult plan = inputs.run(plan_words(test::with({"--template", c.name}, c.plan)));
    ASSERT_EQ(plan.exit_code, 0) << plan.err;
    expect_has(plan.out, c.file + ": RMS ");
    const json summary = json::parse(read_whole_file(inputs / "plan/summary.json"));
    EXPECT_EQ(summary["options"]["template"], c.name);
    const json& written = summary["exports"].back();
    EXPECT_EQ(written["format"], "template");
    EXPECT_EQ(written["file"], c.file);
    EXPECT_EQ(written["sha256"], sha256_of_file(inputs / ("plan/" + c.file)));
    const double left = written["rms_nm"], planned = summary["program"]["residual_rms_nm"];
    const json& peer = summary["exports"].front();
    const double expected = summary["exports"].size() > 1 ? peer["rms_nm"].get<double>() : planned;
    EXPECT_NEAR(left, expected, c.within * expected);
    const bool feeds_on_machine = c.name == "siemens-840d" && !c.plan.empty();
    const ProgramResult alone = inputs.run(
        simulate_words("plan/" + c.file,
                       test::with({"--template", c.name}, feeds_on_machine || c.name == "galil" ? machine : Words{})));
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    const json found = json::parse(alone.out);
    EXPECT_NEAR(found["program"]["residual_rms_nm"].get<double>(), left, 1e-3 * left);
    EXPECT_TRUE(found["differences"].empty()) << found["differences"];
  }
}

// The figures are of different lattices up to here; these are of one and the same.
TEST(TemplateCommand, LeavesWhatTheSameProgramLeavesAsGcode) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(plan_words({"--template", "siemens-840d", "--zero", "3,-1", "--rotate", "30"})).exit_code, 0);
  const auto left_by = [&inputs](const std::string& file, const Words& more) {
    const ProgramResult result = inputs.run(simulate_words(file, test::with({"--exact"}, more)));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out)["program"]["residual_rms_nm"].get<double>();
  };
  const double gcode = left_by("plan/program.nc", {});
  EXPECT_NEAR(left_by("plan/program_by_template.mpf", {"--template", "siemens-840d"}), gcode, 1e-6 * gcode);
  // By its name in the plan's folder it is known as the plan's program by its template.
  const ProgramResult of_plan =
      inputs.run({"simulate", "plan", "--program", "plan/program_by_template.mpf", "--exact", "--json"});
  ASSERT_EQ(of_plan.exit_code, 0) << of_plan.err;
  EXPECT_NEAR(json::parse(of_plan.out)["program"]["residual_rms_nm"].get<double>(), gcode, 1e-6 * gcode);
}

TEST(TemplateCommand, APlanOfSpeedsIsSimulatedByItsTemplate) {
  const SmallInputs inputs;
  inputs.folder.file("m.toml", kLimits);
  inputs.folder.file("shop.toml",
                     read_whole_file(std::string(DWELL_SOURCE_DIR) + "/data/templates/aerotech_a3200.toml"));
  ASSERT_EQ(
      inputs.run(plan_words({"--template", "shop.toml", "--machine", "m.toml", "--schedule", "linear"})).exit_code, 0);
  EXPECT_FALSE(test::names_in(inputs / "plan").contains("program.nc"));
  const json summary = json::parse(read_whole_file(inputs / "plan/summary.json"));
  EXPECT_EQ(summary["program"]["file"], "program_by_template.pgm");
  const ProgramResult simulated = inputs.run({"simulate", "plan", "--json"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  EXPECT_NEAR(json::parse(simulated.out)["program"]["residual_rms_nm"].get<double>(),
              summary["program"]["residual_rms_nm"].get<double>(),
              1e-3 * summary["program"]["residual_rms_nm"].get<double>());
  // By a template that has changed it would be another program.
  inputs.folder.file("shop.toml", read_whole_file(std::string(DWELL_SOURCE_DIR) + "/data/templates/galil.toml"));
  const ProgramResult changed = inputs.run({"simulate", "plan"});
  EXPECT_EQ(changed.exit_code, 2);
  expect_has(changed.err, "shop.toml: the template has changed since the plan was made");
  // The next plan takes its place, whatever the ending is.
  EXPECT_EQ(inputs.run(plan_words({})).exit_code, 0);
  EXPECT_FALSE(test::names_in(inputs / "plan").contains("program_by_template.pgm"));
}

TEST(TemplateCommand, SaysWhatItNeeds) {
  const SmallInputs inputs;
  inputs.folder.file("m.toml", kLimits);
  inputs.folder.file("bad.toml", "schema = 1\nname = \"x\"\nspeeds = 3\n");
  const auto refused = [&inputs](const Words& more, const std::string& says) {
    const ProgramResult result = inputs.run(plan_words(more));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    expect_has(result.err, says);
  };
  refused({"--template", "galil"},
          "--template = galil: such a program is the motion of a machine; required a --machine");
  refused({"--template", "fanuc", "--machine", "m.toml", "--schedule", "linear", "--export", "pvt-csv"},
          "--template = fanuc: its moves say feeds");
  refused({"--template", "galil", "--machine", "m.toml", "--zero", "1,2"}, "required one of the two");
  refused({"--template", "bad.toml"}, "bad.toml: line 3: speeds = 3; required true or false");
  refused({"--template", "none.toml"}, "or the name of one that comes with dwell: aerotech-a3200");
  // A program is read by its template alone, and holds to the map it was made for.
  ASSERT_EQ(inputs.run(plan_words({"--template", "fanuc"})).exit_code, 0);
  const std::string file = "plan/program_by_template.tap";
  const ProgramResult dialect = inputs.run(simulate_words(file, {"--template", "fanuc", "--gcode", "g93-seconds"}));
  EXPECT_EQ(dialect.exit_code, 2);
  expect_has(dialect.err, "is read by the template fanuc, for which a G-code dialect");
  const ProgramResult other = inputs.run(simulate_words(file, {"--template", "siemens-840d"}));
  EXPECT_EQ(other.exit_code, 2);
  expect_has(other.err, "program_by_template.tap, line ");
  const ProgramResult map = inputs.run({"simulate", "--program", file, "--template", "fanuc", "--map", "tif.csv",
                                        "--map-pixel", "0.5", "--tif", "tif.csv", "--tif-pixel", "0.5"});
  EXPECT_EQ(map.exit_code, 2);
  expect_has(map.err, "--other-map");
}

}  // namespace
}  // namespace dwell
