#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include "core/base/whole_file.h"
#include "runs/machine/machine_file.h"
#include "tests/cli/small_inputs.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;

const std::vector<std::string> kTurning{"--path", "random:pitch=1.5,seed=2", "--max-feed", "600"};

TEST(MachineCommand, PrintsAnExampleThatItReads) {
  const SmallInputs inputs;
  const ProgramResult example = inputs.run({"machine", "--example"});
  ASSERT_EQ(example.exit_code, 0) << example.err;
  inputs.folder.file("m.toml", example.out);
  const ProgramResult shown = inputs.run({"machine", "m.toml"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  expect_has(shown.out, "corners   exact-stop");
  expect_has(shown.out, "from 300 mm/min 10 ms over 0.05 mm");
  EXPECT_EQ(inputs.run({"machine"}).exit_code, 2);
  EXPECT_EQ(inputs.run({"machine", "m.toml", "--example"}).exit_code, 2);
  EXPECT_EQ(inputs.run({"machine", "--example", "--json"}).exit_code, 2);
  const ProgramResult absent = inputs.run({"machine", "none.toml"});
  EXPECT_EQ(absent.exit_code, 2);
  expect_has(absent.err, "none.toml");
}

TEST(MachineCommand, ExecutesAProgramAndSaysWhatThatCosts) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan(kTurning)).exit_code, 0);
  inputs.folder.file("quick.toml", "path_acceleration_mm_per_s2 = 1e9\n[corner]\nrule = \"free\"\n");
  inputs.folder.file("slow.toml", "path_acceleration_mm_per_s2 = 20\nmax_feed_mm_per_min = 600\n");
  const auto simulated = [&inputs](const std::vector<std::string>& more) {
    std::vector<std::string> words{"simulate", "plan", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  };
  const json commanded = simulated({}), quick = simulated({"--machine", "quick.toml"}),
             slow = simulated({"--machine", "slow.toml"});
  const double rms = commanded["program"]["residual_rms_nm"];
  EXPECT_FALSE(commanded.contains("executed"));
  // A machine without limits does as commanded.
  EXPECT_NEAR(quick["program"]["residual_rms_nm"].get<double>(), rms, 1e-6 * rms);
  EXPECT_EQ(quick["executed"]["slow_steps"], 0);
  // One that must stop at every corner is late, removes more there, and says both figures.
  EXPECT_GT(slow["program"]["residual_rms_nm"].get<double>(), 1.5 * rms);
  EXPECT_NEAR(slow["executed"]["commanded_rms_nm"].get<double>(), rms, 1e-9);
  EXPECT_GT(slow["executed"]["total_s"].get<double>(), 1.1 * slow["executed"]["commanded_total_s"].get<double>());
  EXPECT_GT(slow["executed"]["slow_steps"], 10);
  EXPECT_EQ(slow["inputs"][1]["role"], "machine");
  const ProgramResult text = inputs.run({"simulate", "plan", "--machine", "slow.toml"});
  expect_has(text.out, "executed  ");
  expect_has(text.out, "if every move had its speed from end to end");
}

TEST(MachineCommand, WritesTheMotion) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan(kTurning)).exit_code, 0);
  inputs.folder.file("slow.toml", "path_acceleration_mm_per_s2 = 20\nmax_feed_mm_per_min = 600\nname = \"slow\"\n");
  const ProgramResult result =
      inputs.run({"simulate", "plan", "--json", "--machine", "slow.toml", "--motion-table", "motion.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json said = json::parse(result.out);
  std::istringstream table(read_whole_file(inputs / "motion.csv"));
  std::string line, header;
  double last = -1.0;
  std::size_t rows = 0, rests = 0;
  while (std::getline(table, line)) {
    if (line.starts_with("#")) {
      header += line;
      continue;
    }
    if (line == "t_s,x_mm,y_mm,speed_mm_per_s,removes") continue;
    double t = 0.0, x = 0.0, y = 0.0, speed = 0.0;
    int removes = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%d", &t, &x, &y, &speed, &removes), 5) << line;
    EXPECT_GE(t, last);
    EXPECT_LE(speed, 10.0 + 1e-6);
    last = t;
    ++rows;
    rests += static_cast<std::size_t>(speed == 0.0);
  }
  expect_has(header, "machine: slow");
  EXPECT_GT(rows, 100U);
  EXPECT_GT(rests, 20U);  // it turns at every point
  // The table has not the way up at the end of a program and down at its begin.
  EXPECT_NEAR(last, said["executed"]["total_s"].get<double>(), 1.5);
  EXPECT_LE(last, said["executed"]["total_s"].get<double>() + 1e-6);
  const ProgramResult without = inputs.run({"simulate", "plan", "--motion-table", "other.csv"});
  EXPECT_EQ(without.exit_code, 2);
  expect_has(without.err, "--motion-table: of the motion of a machine; give --machine FILE");
  const ProgramResult image = inputs.run({"simulate", "plan", "--machine", "slow.toml", "--motion-table", "m.png"});
  EXPECT_EQ(image.exit_code, 2);
  expect_has(image.err, "extension '.png'; accepted: .csv");
  EXPECT_FALSE(std::filesystem::exists(inputs / "other.csv"));
}

TEST(MachineCommand, SaysWhatAProgramAsksBeyondTheMachine) {
  const SmallInputs inputs;
  ASSERT_EQ(inputs.run(SmallInputs::plan(kTurning)).exit_code, 0);
  inputs.folder.file("small.toml", "max_feed_mm_per_min = 30\n[x]\nlowest_mm = 0\nhighest_mm = 3\n");
  const ProgramResult result = inputs.run({"simulate", "plan", "--machine", "small.toml"});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  expect_has(result.err, "leave the machine's travel of x from 0 to 3 mm: the first is step ");
  expect_has(result.err, "are faster than the machine: the first is step ");
  inputs.folder.file("wrong.toml", "path_acceleration = 3\n");
  const ProgramResult refused = inputs.run({"simulate", "plan", "--machine", "wrong.toml"});
  EXPECT_EQ(refused.exit_code, 2);
  expect_has(refused.err, "wrong.toml: line 1: path_acceleration: unknown field; accepted: ");
}

TEST(MachineCommand, PlansForAMachineAndSimulatesThePlanOnIt) {
  const SmallInputs inputs;
  inputs.folder.file("slow.toml", "path_acceleration_mm_per_s2 = 40\nname = \"the slow one\"\n");
  std::vector<std::string> words = kTurning;
  words.insert(words.end(), {"--machine", "slow.toml", "--smoothness", "0.1"});
  const ProgramResult plan = inputs.run(SmallInputs::plan(words));
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  expect_has(plan.out, "machine   the slow one");
  expect_has(plan.out, "nm RMS executed, ");
  expect_has(plan.out, "by simulating program.nc as read back, executed on the machine");
  const json summary = json::parse(read_whole_file(inputs / "plan/summary.json"));
  const double rms = summary["program"]["residual_rms_nm"];
  EXPECT_LE(summary["motion"]["executed_rms_nm"].get<double>(),
            1.1 * summary["motion"]["planned_rms_nm"].get<double>());
  // The plan's folder knows its machine.
  const ProgramResult again = inputs.run({"simulate", "plan", "--json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NEAR(json::parse(again.out)["program"]["residual_rms_nm"].get<double>(), rms, 1e-9);
  EXPECT_NEAR(json::parse(again.out)["executed"]["total_s"].get<double>(), summary["total_s"].get<double>(), 1e-6);
  EXPECT_NEAR(json::parse(again.out)["program"]["total_s"].get<double>(), summary["total_s"].get<double>(), 1e-6);
  EXPECT_EQ(summary["program"]["total_s"], summary["total_s"]);
  const ProgramResult commanded = inputs.run({"simulate", "plan", "--machine", "none", "--json"});
  ASSERT_EQ(commanded.exit_code, 0) << commanded.err;
  EXPECT_FALSE(json::parse(commanded.out).contains("executed"));
  EXPECT_GT(json::parse(commanded.out)["program"]["residual_rms_nm"].get<double>(), 1.5 * rms);
  // Another file in its place is said, a changed one is refused.
  inputs.folder.file("slow.toml", "path_acceleration_mm_per_s2 = 41\n");
  const ProgramResult changed = inputs.run({"simulate", "plan"});
  EXPECT_EQ(changed.exit_code, 2);
  expect_has(changed.err, "slow.toml: has changed since the plan");
}

TEST(MachineCommand, HasItsFieldsInTheDocuments) {
  const std::string text = read_whole_file(DWELL_SOURCE_DIR "/docs/motion.md");
  for (const MachineField& field : machine_fields()) expect_has(text, "`" + field.key + "`");
}

}  // namespace
}  // namespace dwell
