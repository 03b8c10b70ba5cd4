/// dwell figure as a shop uses it: the built program, its texts, its exit codes and its folder.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

#include "core/base/whole_file.h"
#include "core/formats/map_io.h"
#include "core/map/map_turn.h"
#include "runs/figure/store/run_lock.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/program_reader.h"
#include "tests/cli/documented_runs.h"
#include "tests/cli/json_documentation.h"
#include "tests/cli/small_inputs.h"
#include "tests/runs/logs/made_up_log.h"

namespace dwell {
namespace {

using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

const Words kPart{"--map",       "map.csv", "--map-pixel", "0.5", "--tif",  "tif.csv",
                  "--tif-pixel", "0.5",     "--threads",   "1",   "--path", "raster:pitch=1,overrun=2"};

/// A folder with a run that is planned, and the map after it by a tool that removes 10 % more.
struct FigureInputs : SmallInputs {
  FigureInputs() {
    EXPECT_EQ(run(with({"figure", "new", "run"}, kPart)).exit_code, 0);
    const ProgramResult plan = run({"figure", "plan", "run"});
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    EXPECT_EQ(run({"simulate", "run/02-plan-1", "--tif-rate", "1.1", "--residual", "second.npy"}).exit_code, 0);
    write_map(*this / "flipped.npy", turn_map(read_map(*this / "second.npy"), GridTurn::FlipX));
  }

  /// A copy of the run under another name.
  void copy(const std::string& name, const std::string& from = "run") const {
    std::filesystem::copy(*this / from, *this / name, std::filesystem::copy_options::recursive);
  }
};

TEST(FigureCommand, TakesAPartFromMapToMap) {
  const FigureInputs inputs;
  const ProgramResult measured = inputs.run({"figure", "measured", "run", "second.npy"});
  EXPECT_EQ(measured.exit_code, 0) << measured.err;
  expect_has(measured.out, "tool      rate x 1.1 +-");
  expect_has(measured.out, "learnt    rate 1.1");
  expect_has(measured.out, "advice    another run");
  const ProgramResult plan = inputs.run({"figure", "plan", "run"});
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  expect_has(plan.out, "Run 2: program.nc");
  expect_has(plan.out, "1.1 times its volume rate");
  // The prediction of the second run is what the tool, as it is in truth, then leaves.
  EXPECT_EQ(inputs.run({"simulate", "run/04-plan-2", "--tif-rate", "1.1", "--residual", "third.npy"}).exit_code, 0);
  const auto summary = nlohmann::json::parse(read_whole_file(inputs / "run/04-plan-2/step.json"));
  const double predicted = summary["content"]["predicted"]["rms_nm"];
  const auto truth = nlohmann::json::parse(
      inputs.run({"simulate", "run/04-plan-2", "--tif-rate", "1.1", "--json"}).out)["program"]["residual_rms_nm"];
  EXPECT_NEAR(predicted, truth.get<double>(), 0.03 * predicted);
  const ProgramResult status = inputs.run({"figure", "status", "run"});
  expect_has(status.out, "next      run run/04-plan-2/program.nc");
  EXPECT_EQ(inputs.run({"figure", "check", "run"}).exit_code, 0);
  for (const char* file : {"setup.pdf", "setup.txt", "program.nc", "summary.json", "job.toml", "residual.npy"})
    EXPECT_TRUE(std::filesystem::exists(inputs / "run/04-plan-2" / file)) << file;
}

TEST(FigureCommand, SaysThatAMapLiesOtherwiseAndKeepsNothing) {
  const FigureInputs inputs;
  const ProgramResult flipped = inputs.run({"figure", "measured", "run", "flipped.npy"});
  EXPECT_EQ(flipped.exit_code, 3);
  expect_has(flipped.err, "--step 'flip:x'");
  expect_has(flipped.out, "kept      nothing");
  EXPECT_FALSE(std::filesystem::exists(inputs / "run/03-measured-1"));
  EXPECT_EQ(inputs.run({"figure", "measured", "run", "flipped.npy", "--step", "flip:x"}).exit_code, 0);
}

TEST(FigureCommand, RefusesWhatItCannotUse) {
  const FigureInputs inputs;
  const auto refused = [&](const Words& words, const std::string& part) {
    const ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    expect_has(result.err, part);
  };
  refused(with({"figure", "new", "run"}, kPart), "is a figure run already");
  refused(with({"figure", "new", "other", "--target", "rms<=1kg"}, kPart), "--target");
  refused({"figure", "new", "other"}, "--map, --tif, --path: required");
  refused({"figure", "plan", "nowhere"}, "nowhere");
  refused({"figure", "measured", "run", "second.npy", "--learn", "speed=take"}, "accepted: rate, width");
  refused({"figure", "measured", "run", "second.npy", "--log-period", "1"}, "--log FILE is required");
  refused({"figure", "measured", "run", "nothing.npy"}, "nothing.npy");
  refused({"figure", "withdraw", "run", "2"}, "no measurement that counts");
  refused({"figure", "simulate", "run", "--uncertainty", "tif-rate=0.1"}, "required a number in %");
  refused({"figure", "simulate", "run", "--samples", "0"}, "--samples 0: required");
  {
    const RunLock held((inputs / "run").string());
    refused({"figure", "plan", "run"}, "is being changed by process");
  }
  std::ofstream(inputs / "run/01-new/map.npy", std::ios::app) << "x";
  const ProgramResult check = inputs.run({"figure", "check", "run"});
  EXPECT_EQ(check.exit_code, 3);
  expect_has(check.err, "01-new/map.npy: is another than when it was written");
}

TEST(FigureCommand, SimulatesCampaignsTheSameEveryTime) {
  const FigureInputs inputs;
  const Words words{"figure", "simulate", "run", "--runs", "2", "--samples", "2", "--uncertainty", "tif-rate=10%"};
  const ProgramResult once = inputs.run(words);
  EXPECT_EQ(once.exit_code, 0) << once.err;
  expect_has(once.out, "run 2     leaves");
  EXPECT_EQ(once.out, inputs.run(words).out);
}

TEST(FigureCommand, PrintsTheJsonThatIsDocumented) {
  const FigureInputs inputs;
  EXPECT_EQ(inputs.run(with({"figure", "new", "targeted", "--target", "rms<=5nm"}, kPart)).exit_code, 0);
  inputs.copy("planned");
  inputs.copy("ready");
  inputs.copy("flipped");
  inputs.copy("spoilt");
  std::filesystem::remove(inputs / "spoilt/01-new/map.npy");
  EXPECT_EQ(inputs.run({"figure", "measured", "run", "second.npy"}).exit_code, 0);
  inputs.copy("measured");
  EXPECT_EQ(inputs.run({"figure", "plan", "targeted"}).exit_code, 0);
  inputs.copy("targeted-ready", "targeted");
  EXPECT_EQ(inputs.run({"simulate", "targeted/02-plan-1", "--tif-rate", "0.9", "--residual", "after.npy"}).exit_code,
            0);
  const MotionLog log =
      test::made_up_log(read_program(inputs / "targeted/02-plan-1/program.nc"), example_machine().machine);
  inputs.folder.file("figure-run.csv", test::log_text(log, "t_s,x_mm,y_mm"));
  const std::map<std::string, std::vector<Words>> runs{
      {"figure new",
       {with({"figure", "new", "n"}, kPart), with({"figure", "new", "nt", "--target", "rms<=1nm"}, kPart)}},
      {"figure plan", {{"figure", "plan", "planned"}, {"figure", "plan", "targeted"}}},
      {"figure measured",
       {{"figure", "measured", "ready", "second.npy"},
        {"figure", "measured", "targeted-ready", "after.npy", "--log", "figure-run.csv"},
        {"figure", "measured", "flipped", "flipped.npy"}}},
      {"figure status", {{"figure", "status", "run"}}},
      {"figure check", {{"figure", "check", "run"}, {"figure", "check", "spoilt"}}},
      {"figure withdraw", {{"figure", "withdraw", "measured", "3", "--why", "dust"}}},
      {"figure simulate",
       {{"figure", "simulate", "run", "--runs", "1", "--samples", "2", "--uncertainty", "tif-rate=10%"}}}};
  const test::JsonDocumentation documentation(DWELL_SOURCE_DIR "/docs/json.md");
  for (const auto& [command, keys] : documentation.commands()) {
    if (!command.starts_with("figure ")) continue;
    ASSERT_TRUE(runs.contains(command)) << command;
    test::expect_documented(inputs, command, keys, runs.at(command));
  }
}

TEST(FigureCommand, HasExamplesWhoseWordsAreAccepted) {
  for (const char* command : {"figure", "figure new", "figure plan", "figure measured", "figure status", "figure check",
                              "figure withdraw", "figure simulate"})
    test::expect_examples(command);
}

}  // namespace
}  // namespace dwell
