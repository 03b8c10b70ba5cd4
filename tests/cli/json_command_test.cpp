/// --json is one flag with one meaning in every command, and docs/json.md lists the keys that it prints.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/whole_file.h"
#include "runs/job/job_options.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/program_reader.h"
#include "tests/cli/documented_runs.h"
#include "tests/cli/json_documentation.h"
#include "tests/cli/small_inputs.h"
#include "tests/core/tif/calibration/spot_truth.h"
#include "tests/runs/logs/made_up_log.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

const Words kMap{"map", "map.csv", "--map-pixel", "0.5"};
const Words kSimulate{"simulate", "--program", "plan/program.nc", "--map",       "map.csv", "--map-pixel",
                      "0.5",      "--tif",     "tif.csv",         "--tif-pixel", "0.5",     "--threads",
                      "1"};

/// The usual plan as another command, which does not take the options named in `without`.
Words as(const char* command, const Words& without, const Words& more) {
  Words words = with(SmallInputs::plan(), more);
  words[0] = command;
  for (const std::string& flag : without) {
    const auto at = std::find(words.begin(), words.end(), flag);
    words.erase(at, at + 2);
  }
  return words;
}

/// A folder in which every command can run, with a plan in it.
struct CommandInputs : SmallInputs {
  CommandInputs() {
    const Grid grid{90, 140, 0.15, 0.15, {-10.0, -7.0}};
    write_map(*this / "after.csv", test::after_spots(grid, {{-4.52, -0.31}, {5.01, 0.77}}, 4.0, 0.1, 2));
    HeightMap trench(Grid{60, 120, 0.2, 0.2, {-12.0, -6.0}});
    for (Index i = 0; i < trench.grid.size(); ++i) {
      const double y = trench.grid.centre(i).y;
      trench.values[static_cast<std::size_t>(i)] = -30.0 * std::exp(-y * y);
    }
    write_map(*this / "trench.csv", trench);
    HeightMap wide(Grid{120, 120, 0.5, 0.5, {}});
    for (Index i = 0; i < wide.grid.size(); ++i) {
      const Point p = wide.grid.centre(i);
      wide.values[static_cast<std::size_t>(i)] = 20.0 * std::sin(0.3 * p.x + 0.1) * std::cos(0.7 * p.y) + 30.0;
    }
    write_map(*this / "wide.csv", wide);
    HeightMap specked(Grid{60, 72, 0.5, 0.5, {}});
    for (Index i = 0; i < specked.grid.size(); ++i) {
      const Point p = specked.grid.centre(i);
      specked.values[static_cast<std::size_t>(i)] =
          20.0 * std::sin(0.2 * p.x) * std::cos(0.15 * p.y) + std::sin(17.0 * p.x * p.y + static_cast<double>(i % 7));
    }
    specked.at(30, 40) += 200.0, specked.at(30, 41) += 200.0;
    write_map(*this / "specked.csv", specked);
    const ProgramResult machine = run({"machine", "--example"});
    EXPECT_EQ(machine.exit_code, 0);
    folder.file("machine.toml", machine.out);
    folder.file("blocks.toml", "path_acceleration_mm_per_s2 = 500\n[controller]\nmax_blocks_per_s = 20\n");
    folder.file("line.txt", "x_mm slope_urad\n0 -112.01\n20 -56.96\n35 -15.26\n60 54.61\n80 111.11\n100 167.97\n");
    EXPECT_EQ(run(SmallInputs::plan()).exit_code, 0);
    const MotionLog log = test::made_up_log(read_program(*this / "plan/program.nc"), example_machine().machine);
    folder.file("run.csv", test::log_text(log, "t_s,x_mm,y_mm"));
    EXPECT_EQ(run(SmallInputs::plan({"--map", "specked.csv", "--out", "specked"})).exit_code, 0);
  }
};

/// Runs of each command that between them print every key.
std::map<std::string, std::vector<Words>> runs_of_commands() {
  return {
      {"plan",
       {SmallInputs::plan({"--out", "a", "--time-price", "auto"}),
        SmallInputs::plan({"--out", "a", "--smoothness", "step<=0.05", "--tif-pedestal", "taper"}),
        SmallInputs::plan({"--map", "specked.csv", "--out", "a", "--blemishes", "leave-out"}),
        SmallInputs::plan({"--out", "a", "--machine", "machine.toml", "--export", "pvt-csv,xps-trj"}),
        SmallInputs::plan({"--out", "a", "--machine", "blocks.toml", "--accept", "rms<=1um, mid<=1pm, slope<=3mrad"}),
        {"plan", "--resume", "200", "--log-plan", "plan", "--out", "a"},
        SmallInputs::plan(
            {"--out", "a", "--objective", "mixed:0.5", "--clear-aperture", "rect:1,1,9,8", "--weight", "centre=2"}),
        SmallInputs::plan({"--out", "a", "--uncertainty", "tif-rate=5%,position=20um,samples=3", "--robust-plan"}),
        {"plan", "--log", "run.csv", "--log-plan", "plan", "--machine", "machine.toml", "--out", "a"}}},
      {"paths",
       {{"paths", "--map", "wide.csv", "--tif", "gaussian:peak=10,fwhm=3,radius=4", "--threads", "1", "--paths",
         "raster:pitch=2;nearest:critical=1e9", "--out", "b"},
        as("paths", {"--path", "--out"}, {"--paths", "raster:pitch=2", "--out", "g", "--tif-pedestal", "taper"}),
        as("paths", {"--path", "--tif", "--tif-pixel", "--out"},
           {"--tif", "gaussian:peak=10,fwhm=5,radius=5", "--paths", "raster:pitch=2", "--out", "b", "--aperture",
            "rect:0,0,14,1.2"})}},
      {"pareto",
       {as("pareto", {"--time-price", "--out"},
           {"--smoothnesses", "0.1,1", "--time-prices", "0", "--out", "c", "--tif-pedestal", "taper"})}},
      {"simulate",
       {kSimulate,
        with(kSimulate, {"--exact", "--tif-pedestal", "subtract", "--accept", "pv<=1, band(2..8mm)<=1um"}),
        {"simulate", "plan"},
        {"simulate", "specked"},
        with(kSimulate, {"--weight", "edge:width=1,weight=0.5"}),
        {"simulate", "plan", "--machine", "machine.toml"},
        {"simulate", "plan", "--machine", "machine.toml", "--log", "run.csv"}}},
      {"machine", {{"machine", "machine.toml"}}},
      {"machine fit", {{"machine", "fit", "run.csv", "--program", "plan/program.nc"}}},
      {"map",
       {kMap,
        with(kMap, {"--form", "zernike-noll:1-6", "--remove", "legendre:1", "--limit", "1e-9,2", "--profile", "y=3"}),
        with(kMap, {"--form", "legendre:2", "--limit", "radial:1e9,2", "--accept", "pvr<=1,mid<=9"})}},
      {"profile", {{"profile", "line.txt", "--remove", "ellipse:p=7500,q=2500,angle=0.6"}, {"profile", "line.txt"}}},
      {"tif",
       {{"tif", "gaussian:peak=2,fwhm=3,radius=4"},
        {"tif", "tif.csv", "--tif-pixel", "0.5", "--tif-pedestal", "taper"},
        {"tif", "--spot", "after.csv", "--dwell-time", "4", "--fit", "gaussian", "--threads", "1"},
        {"tif", "--trench", "trench.csv", "--feed", "60"}}},
      {"example", {{"example", "--out", "d", "--width", "20"}}},
  };
}

TEST(JsonOfEveryCommand, HasTheKeysThatAreDocumentedAndNoOthers) {
  const CommandInputs inputs;
  const test::JsonDocumentation documentation(DWELL_SOURCE_DIR "/docs/json.md");
  const auto runs = runs_of_commands();
  for (const auto& [command, keys] : documentation.commands()) {
    if (command.starts_with("figure ")) continue;  // figure_command_test.cpp
    if (command == "plan --tool") continue;        // joint_plan_command_test.cpp
    ASSERT_TRUE(runs.contains(command)) << command;
    test::expect_documented(inputs, command, keys, runs.at(command));
  }
}

TEST(JsonOfEveryCommand, NamesOptionsAsTheJobFileDoes) {
  const CommandInputs inputs;
  const json plan = json::parse(read_whole_file(inputs / "plan/summary.json"));
  std::set<std::string> known;
  for (const JobOptionRecord& record : job_option_table()) known.insert(record.key);
  for (const auto& [key, value] : plan["options"].items()) EXPECT_TRUE(known.contains(key)) << key;
}

// The same map and the same removal function, told by whoever: equal key by key.
TEST(JsonOfEveryCommand, TellsTheSameMapAndToolTheSameWay) {
  const CommandInputs inputs;
  const json plan = json::parse(read_whole_file(inputs / "plan/summary.json"));
  const auto printed = [&](const Words& words) { return json::parse(inputs.run(with(words, {"--json"})).out); };
  const json map = printed(with(kMap, {"--threads", "1"})), simulated = printed(kSimulate);
  const json tif = printed({"tif", "tif.csv", "--tif-pixel", "0.5"});
  ASSERT_EQ(map["map"].size(), plan["map"].size());
  for (const auto& [key, value] : plan["map"].items()) {
    EXPECT_EQ(simulated["map"][key], value) << key;
    if (value.is_number_float()) {
      EXPECT_NEAR(map["map"][key].get<double>(), value.get<double>(), 1e-9) << key;
    } else {
      EXPECT_EQ(map["map"][key], value) << key;
    }
  }
  EXPECT_EQ(simulated["tif"], plan["tif"]);
  for (const char* key : {"kind", "peak_nm_per_s", "volume_nm_mm2_per_s", "fwhm_mm", "radius_mm"}) {
    EXPECT_EQ(tif["tif"][key], plan["tif"][key]) << key;
  }
  EXPECT_NEAR(simulated["program"]["residual_rms_nm"].get<double>(), plan["program"]["residual_rms_nm"].get<double>(),
              1e-9);
  EXPECT_EQ(simulated["program"]["steps"], plan["program"]["steps"]);
}

TEST(JsonOfEveryCommand, WritesAFileBesideTheText) {
  const CommandInputs inputs;
  for (const auto& [command, runs] : runs_of_commands()) {
    const std::string file = command + ".json";
    const ProgramResult result = inputs.run(with(runs[0], {"--json=" + file}));
    ASSERT_TRUE(result.exit_code == 0 || result.exit_code == 3) << command << ": " << result.err;
    EXPECT_EQ(json::parse(read_whole_file(inputs / file))["command"], command);
    EXPECT_NE(result.out, "") << command;
    EXPECT_FALSE(result.out.starts_with("{")) << command;
  }
}

TEST(JsonOfEveryCommand, RefusesAFileWithoutTheEqualsSignBeforeAnyWork) {
  const CommandInputs inputs;
  const std::size_t before = inputs.folder.entries();
  for (const auto& [command, runs] : runs_of_commands()) {
    const auto refused = [&, &words = runs[0]](const Words& more, const Words& parts) {
      const ProgramResult result = inputs.run(with(words, more));
      EXPECT_EQ(result.exit_code, 2) << words[0];
      EXPECT_EQ(result.out, "") << words[0];
      for (const std::string& part : parts) expect_has(result.err, part);
      EXPECT_EQ(inputs.folder.entries(), before) << words[0];
    };
    refused({"--json", "out.json"}, {"--json out.json", "--json=out.json", "standard output"});
    refused({"--json="}, {"--json=: empty", "--json=FILE.json"});
    refused({"--json=out.txt"}, {"--json 'out.txt'", "accepted: .json"});
    refused({"--json=no/such/out.json"}, {"no folder 'no/such'"});
  }
  const ProgramResult map = inputs.run({"map", "--json", "map.json", "--map-pixel", "0.5"});
  EXPECT_EQ(map.exit_code, 2) << "the positional would have taken it";
  expect_has(map.err, "--json=map.json");
}

TEST(JsonOfEveryCommand, RefusesAFileThatIsReadOrThatTheResultsWouldReplace) {
  const CommandInputs inputs;
  ASSERT_EQ(inputs.run(with(kMap, {"--write", "a.npy"})).exit_code, 0);
  inputs.folder.file("job.json", "max_feed_mm_per_min = 3000\n");
  const auto refused = [&](const Words& words, const Words& parts) {
    const ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    for (const std::string& part : parts) expect_has(result.err, part);
  };
  const std::string sidecar = read_whole_file(inputs / "a.npy.json");
  refused(SmallInputs::plan({"--map", "a.npy", "--map-pixel", "0.5", "--json=a.npy.json"}),
          {"--json 'a.npy.json'", "the sidecar of the map"});
  refused(SmallInputs::plan({"--job", "job.json", "--json=job.json"}), {"--json 'job.json'", "the job file"});
  refused(SmallInputs::plan({"--json=plan/own.json"}), {"--json 'plan/own.json'", "--out"});
  refused(SmallInputs::plan({"--out", "plan/", "--json=./plan/own.json"}), {"--json './plan/own.json'", "--out"});
  EXPECT_EQ(read_whole_file(inputs / "a.npy.json"), sidecar);
}

TEST(JsonOfEveryCommand, GoesWithNoFlagThatPrintsSomethingElse) {
  const SmallInputs inputs;
  for (const Words& words : {Words{"map", "--steps", "--json"}, Words{"paths", "--kinds", "--json"},
                             SmallInputs::plan({"--write-job", "--json=job.json"})}) {
    const ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    expect_has(result.err, "--json: not with --");
  }
}

// An example parses if it fails, if at all, for the files that are not there: the words themselves are accepted.
TEST(Help, HasExamplesWhoseWordsAreAccepted) {
  for (const auto& [command, runs] : runs_of_commands()) test::expect_examples(command);
}

}  // namespace
}  // namespace dwell
