#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

/// A folder with a plan whose options are not the usual ones.
struct PlanInputs : SmallInputs {
  PlanInputs() {
    std::string tif;
    for (int r = -6; r <= 6; ++r) {
      for (int c = -6; c <= 6; ++c)
        tif += std::to_string(10.0 * std::exp(-0.09 * ((r - 0.3) * (r - 0.3) + (c + 0.2) * (c + 0.2)))) +
               (c < 6 ? "," : "\n");
    }
    folder.file("tif.csv", tif);
    EXPECT_EQ(run(SmallInputs::plan({"--tif-centre", "centroid", "--remove", "piston", "--aperture", "rect:0,0,12,9"}))
                  .exit_code,
              0);
  }

  /// Another map, or rates, of the same size.
  void scale(const std::string& from, const std::string& to, double factor) const {
    MapReadOptions half_millimetre;
    half_millimetre.pitch = square_pitch(0.5);
    const HeightMap map = read_map(*this / from, half_millimetre);
    std::string text;
    for (Index r = 0; r < map.grid.rows; ++r) {
      for (Index c = 0; c < map.grid.cols; ++c)
        text += std::to_string(factor * map.at(r, c)) + (c + 1 < map.grid.cols ? "," : "\n");
    }
    folder.file(to, text);
  }

  json printed(const Words& words) const {
    const ProgramResult result = run(with(words, {"--json"}));
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 3) << result.err;
    return json::parse(result.out);
  }

  void refused(const Words& words, const Words& parts) const {
    const ProgramResult result = run(words);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    for (const std::string& part : parts) expect_has(result.err, part);
  }
};

const Words kAlone{"simulate",  "--program", "plan/program.nc", "--map-pixel", "0.5", "--tif-pixel", "0.5",
                   "--threads", "1"};

TEST(SimulatePlan, TakesEveryOptionFromTheSummaryWhereverTheFolderLies) {
  const PlanInputs inputs;
  const json plan = json::parse(read_whole_file(inputs / "plan/summary.json"));
  for (const char* folder : {"plan", "moved"}) {
    if (!std::filesystem::exists(inputs / folder)) std::filesystem::rename(inputs / "plan", inputs / folder);
    const json s = inputs.printed({"simulate", folder});
    EXPECT_EQ(s["plan"], folder);
    EXPECT_TRUE(s["differences"].empty());
    EXPECT_TRUE(s["limits"].empty());
    EXPECT_EQ(s["map"], plan["map"]);
    EXPECT_EQ(s["tif"], plan["tif"]);
    for (const char* key : {"removed", "residual_rms_nm", "residual_pv_nm", "total_s", "steps"})
      EXPECT_EQ(s["program"][key], plan["program"][key]) << key;
  }
}

// Of a path with lifts too, the time of the run is one and the same: in the plan, and in each simulation of its
// program.
TEST(SimulatePlan, SaysTheTimeOfThePlan) {
  const PlanInputs inputs;
  inputs.folder.file("path.csv", "x_mm,y_mm,lift\n1,1,1\n3,1,0\n5,1,0\n1,3,1\n3,3,0\n5,3.5,0\n2,6,1\n4,6,0\n");
  for (const char* motion : {"moving", "stop"}) {
    const Words words =
        SmallInputs::plan({"--path", "file:path.csv", "--motion", motion, "--max-feed", "300", "--lift-height", "7"});
    const ProgramResult made = inputs.run(words);
    ASSERT_TRUE(made.exit_code == 0 || made.exit_code == 3) << made.err;
    const json plan = json::parse(read_whole_file(inputs / "plan/summary.json"));
    const double total = plan["total_s"], lift = plan["lift_s"];
    // Two lifts of 7 mm, and (5, 1) to (1, 3), (5, 3.5) to (2, 6), at 5 mm/s.
    const double way = motion == std::string("stop") ? std::hypot(4.0, 2.0) + std::hypot(3.0, 2.5) : 0.0;
    if (way > 0.0) {
      EXPECT_NEAR(lift, (2 * 7.0 + way) / 5.0, 1e-6);
    }
    EXPECT_GT(lift, 2 * 7.0 / 5.0);
    EXPECT_EQ(plan["program"]["total_s"], total);
    const json simulated = inputs.printed({"simulate", "plan"});
    EXPECT_EQ(simulated["program"]["total_s"], total);
    EXPECT_EQ(simulated["program"]["lift_s"], lift);
    const json alone = inputs.printed(with(kAlone, {"--map", "map.csv", "--tif", "tif.csv"}));
    EXPECT_NEAR(alone["program"]["total_s"].get<double>(), total, 1e-6 * total);
    const ProgramResult text = inputs.run({"simulate", "plan"});
    expect_has(text.out, "of it lifted moves");
    expect_has(text.out, "at the plan's maximum feed");
  }
}

TEST(SimulatePlan, FindsItsFilesFromAnyFolder) {
  const PlanInputs inputs;
  const json plan = json::parse(read_whole_file(inputs / "plan/summary.json"));
  EXPECT_EQ(plan["names_from"], "..");
  std::filesystem::create_directories(inputs / "far/away");
  const ProgramResult result = test::run_program(inputs / "far/away", {"simulate", "../../plan", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["program"]["residual_rms_nm"], plan["program"]["residual_rms_nm"]);
  // The plan alone elsewhere: its names are seen from the current folder.
  std::filesystem::rename(inputs / "plan", inputs / "far/away/plan");
  EXPECT_EQ(inputs.run({"simulate", "far/away/plan"}).exit_code, 0);
  inputs.refused({"simulate", "far/away/plan", "--map", "absent.csv"}, {"absent.csv"});
}

TEST(SimulatePlan, SaysWhoseTheOptionsOfAnotherMapAre) {
  const PlanInputs inputs;
  inputs.folder.file("own.csv", "# pitch_mm: 1\n1,2,3\n4,5,7\n");
  inputs.refused({"simulate", "plan", "--map", "own.csv"},
                 {"own.csv", "--map-pixel", "(--map-pixel 0.5 is of the plan plan; give the option anew"});
}

TEST(SimulatePlan, SaysWhatIsGivenInThePlansPlace) {
  const PlanInputs inputs;
  inputs.scale("map.csv", "second.csv", 0.75);
  const json s = inputs.printed({"simulate", "plan", "--map", "second.csv", "--remove", "none"});
  ASSERT_EQ(s["differences"].size(), 3u);
  EXPECT_EQ(s["differences"][0], "map given instead of the plan's: second.csv; the plan's is map.csv");
  EXPECT_EQ(s["differences"][1], "remove given instead of the plan's: none; the plan's is piston");
  expect_has(s["differences"][2], "was made with the map map.csv (SHA-256 ");
  const ProgramResult said = inputs.run({"simulate", "plan", "--map", "second.csv"});
  expect_has(said.out,
             "plan      plan\ndiffers   map given instead of the plan's: second.csv; the plan's is map.csv\n");
  EXPECT_TRUE(inputs.printed({"simulate", "plan", "--remove", "piston"})["differences"].empty());
  // The plan's own files under any name are no others; copies of them are said to be that.
  for (const Words& own : {Words{"--program", "plan/program.nc"}, Words{"--program", "./plan/../plan/program.nc"},
                           Words{"--map", "./map.csv"}, Words{"--tif", "./tif.csv"}})
    EXPECT_TRUE(inputs.printed(with({"simulate", "plan"}, own))["differences"].empty()) << own[1];
  std::filesystem::copy_file(inputs / "plan/program.nc", inputs / "copy.nc");
  const json copied = inputs.printed({"simulate", "plan", "--program", "copy.nc"});
  ASSERT_EQ(copied["differences"].size(), 1u);
  EXPECT_EQ(copied["differences"][0],
            "program given instead of the plan's: copy.nc; the plan's is plan/program.nc, which holds the same");
}

TEST(SimulatePlan, RefusesFilesThatChangedOrAreGone) {
  const PlanInputs inputs;
  inputs.scale("map.csv", "map.csv", 0.75);
  inputs.refused({"simulate", "plan"}, {"map.csv: has changed since the plan plan was made", "its SHA-256 is ",
                                        ", and was ", "--map map.csv"});
  EXPECT_EQ(inputs.printed({"simulate", "plan", "--map", "map.csv"})["differences"].size(), 1u);
  inputs.scale("tif.csv", "tif.csv", 1.1);
  inputs.refused({"simulate", "plan", "--map", "map.csv"}, {"tif.csv: has changed", "--tif tif.csv"});
  std::filesystem::remove(inputs / "tif.csv");
  inputs.refused({"simulate", "plan", "--map", "map.csv"}, {"tif.csv: the file of the plan's --tif is not there"});
}

TEST(SimulatePlan, RefusesAProgramThatHasChanged) {
  const PlanInputs inputs;
  const std::string program = read_whole_file(inputs / "plan/program.nc");
  inputs.folder.file("plan/program.nc", program + "(one more line)\n");
  inputs.refused({"simulate", "plan"}, {"plan/program.nc", "SHA-256", "--program plan/program.nc"});
  EXPECT_EQ(inputs.run({"simulate", "plan", "--program", "plan/program.nc"}).exit_code, 0);
  inputs.folder.file("plan/program.nc", program);
  EXPECT_EQ(inputs.run({"simulate", "plan"}).exit_code, 0);
}

TEST(SimulatePlan, RefusesAFolderThatIsNoPlan) {
  const PlanInputs inputs;
  for (const char* name : {"empty", "other", "broken", "future"}) std::filesystem::create_directory(inputs / name);
  inputs.folder.file("other/summary.json", "{\"schema\": 2, \"command\": \"pareto\"}");
  inputs.folder.file("broken/summary.json", "{\"schema\": 2");
  inputs.folder.file("future/summary.json",
                     "{\"command\": \"plan\", \"options\": {\"tif_tilt_deg\": \"3\"}, \"inputs\": []}");
  inputs.refused({"simulate", "empty"}, {"empty: is not the folder of a plan", "summary.json"});
  inputs.refused({"simulate", "other"}, {"the result of dwell pareto"});
  inputs.refused({"simulate", "broken"}, {"broken/summary.json: is not a summary of dwell plan"});
  inputs.refused({"simulate", "future"}, {"options.tif_tilt_deg is not known"});
  inputs.refused({"simulate", "absent"}, {"absent: No such file or directory"});
  inputs.refused({"simulate", "map.csv"}, {"map.csv: is a file", "--program"});
  inputs.refused({"simulate"}, {"PLAN or --program: required"});
  inputs.refused({"simulate", "plan", "--json=plan/summary.json"}, {"summary"});
}

TEST(SimulateProgram, ComparesMapAndRemovalFunctionWithItsHeader) {
  const PlanInputs inputs;
  inputs.scale("map.csv", "second.csv", 0.75);
  inputs.scale("tif.csv", "stronger.csv", 1.1);
  const Words same = with(kAlone, {"--map", "map.csv", "--tif", "tif.csv"});
  for (const char* program : {"plan/program.nc", "plan/feed.csv"}) {
    Words other_map = with(kAlone, {"--map", "second.csv", "--tif", "tif.csv"});
    Words other_tif = with(kAlone, {"--map", "map.csv", "--tif", "stronger.csv"});
    Words formula = with(kAlone, {"--map", "map.csv", "--tif", "gaussian:peak=10,fwhm=2.8,radius=3"});
    for (Words* words : {&other_map, &other_tif, &formula}) (*words)[2] = program;
    inputs.refused(other_map, {program, "was made with the map map.csv (SHA-256 ", "second.csv", "--other-map"});
    inputs.refused(other_tif, {program, "the removal function tif.csv (SHA-256 ", "stronger.csv", "--other-tif"});
    EXPECT_EQ(inputs.run(with(other_map, {"--other-tif"})).exit_code, 2);
    expect_has(inputs.printed(with(other_map, {"--other-map"}))["differences"][0], "second.csv");
    expect_has(inputs.printed(with(other_tif, {"--other-tif"}))["differences"][0], "stronger.csv");
    formula.erase(std::find(formula.begin(), formula.end(), "--tif-pixel"),
                  std::find(formula.begin(), formula.end(), "--tif-pixel") + 2);
    inputs.refused(formula, {"gaussian:peak=10", "--other-tif"});
  }
  const json s = inputs.printed(same);
  EXPECT_FALSE(s.contains("plan"));
  EXPECT_EQ(s["differences"], (json{"--tif-centre is auto, but was centroid when the program was made",
                                    "--remove is piston,tilt, but was piston when the program was made",
                                    "--aperture is map, but was rect:0,0,12,9 when the program was made"}));
}

TEST(SimulateProgram, ComparesTheFormulaOfARemovalFunction) {
  const SmallInputs inputs;
  const Words tool{"--tif", "gaussian:peak=10,fwhm=2.8,radius=3"};
  ASSERT_EQ(inputs
                .run({"plan", "--map", "map.csv", "--map-pixel", "0.5", tool[0], tool[1], "--threads", "1", "--path",
                      "raster:pitch=1,overrun=2", "--out", "plan"})
                .exit_code,
            0);
  const Words alone{"simulate", "--program", "plan/program.nc", "--map", "map.csv", "--map-pixel", "0.5"};
  EXPECT_EQ(inputs.run(with(alone, tool)).exit_code, 0);
  const ProgramResult other = inputs.run(with(alone, {"--tif", "gaussian:peak=11,fwhm=2.8,radius=3"}));
  EXPECT_EQ(other.exit_code, 2);
  expect_has(other.err, "was made with the removal function gaussian:peak=10,fwhm=2.8,radius=3");
}

TEST(SimulateProgram, OfOtherOriginIsComparedWithNothing) {
  const PlanInputs inputs;
  inputs.folder.file("a.nc", "(input for the second shift)\nG21 G90 G94\nG0 Z5\nG0 X3 Y4\nG1 Z0 F600\nG1 X4 F60\nM2\n");
  const json s = inputs.printed({"simulate", "--program", "a.nc", "--map", "map.csv", "--map-pixel", "0.5", "--tif",
                                 "tif.csv", "--tif-pixel", "0.5"});
  EXPECT_TRUE(s["differences"].empty());
}

TEST(SimulateProgram, ThatLeavesMoreThanThereWasReachesALimitAsAPlanDoes) {
  const PlanInputs inputs;
  inputs.folder.file("a.nc", "G21 G90 G94\nG0 Z5\nG0 X3 Y4\nG1 Z0 F600\nG1 X4 F0.01\nM2\n");
  const Words words{"simulate", "--program", "a.nc",    "--map",       "map.csv", "--map-pixel",
                    "0.5",      "--tif",     "tif.csv", "--tif-pixel", "0.5"};
  const ProgramResult result = inputs.run(words);
  EXPECT_EQ(result.exit_code, 3);
  expect_has(result.err, "limit reached: the program leaves more than there was: ");
  EXPECT_EQ(inputs.printed(words)["limits"].size(), 1u);
}

}  // namespace
}  // namespace dwell
