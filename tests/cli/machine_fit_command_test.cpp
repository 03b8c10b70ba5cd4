#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

#include "core/base/whole_file.h"
#include "runs/machine/machine_file.h"
#include "runs/programs/program_reader.h"
#include "tests/cli/small_inputs.h"
#include "tests/runs/logs/made_up_log.h"

namespace dwell {
namespace {

using nlohmann::json;
using test::expect_has;
using test::ProgramResult;
using test::SmallInputs;
using test::with;
using test::Words;

const Words kManyCorners{"--path", "random:pitch=1.5,seed=2", "--max-feed", "600"};
const Words kFit{"machine", "fit", "run.csv", "--program", "plan/program.nc"};

/// A plan on a path of many corners, and the log of a machine that ran it.
struct LoggedPlan : SmallInputs {
  Machine machine;

  LoggedPlan() {
    machine.path_acceleration = 45.0;
    machine.corner_delay = 0.004;
    EXPECT_EQ(run(SmallInputs::plan(kManyCorners)).exit_code, 0);
    folder.file("run.csv", test::log_text(log(), "t_ms,x_um,y_mm", 1e-3, 1.0));
  }
  /// With x in um as the header says.
  MotionLog log() const {
    MotionLog made = test::made_up_log(read_program(*this / "plan/program.nc"), machine);
    for (Point& p : made.places) p.x *= 1e3;
    return made;
  }
};

TEST(MachineFitCommand, WritesAMachineThatSimulatesTheRun) {
  const LoggedPlan inputs;
  const ProgramResult fitted = inputs.run(with(kFit, {"--out", "m.toml"}));
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  for (const char* part : {"log       run.csv: ", "aligned   to steps ", "fitted    acceleration along the path 4",
                           "fitted    delay at a corner ", "not known following lag: ", "written   m.toml"})
    expect_has(fitted.out, part);
  const NamedMachine machine = read_machine_file(inputs / "m.toml");
  EXPECT_NEAR(machine.machine.path_acceleration, 45.0, 0.3);
  EXPECT_NEAR(machine.machine.corner_delay, 0.004, 2e-4);
  EXPECT_EQ(machine.name, "fitted to run.csv");
  EXPECT_EQ(inputs.run({"machine", "m.toml"}).exit_code, 0);
  const ProgramResult again = inputs.run(with(kFit, {"--machine", "m.toml", "--json"}));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const json printed = json::parse(again.out);
  EXPECT_EQ(printed["command"], "machine fit");
  EXPECT_EQ(printed["fit"]["fitted"][0]["name"], "path_acceleration");
  EXPECT_NEAR(printed["fit"]["fitted"][0]["value"].get<double>(), 45.0, 0.3);
  EXPECT_EQ(printed["inputs"][2]["role"], "machine");

  // Recorded, simulated on the fitted machine, and commanded beside each other.
  const ProgramResult simulated =
      inputs.run({"simulate", "plan", "--log", "run.csv", "--machine", "m.toml", "--log-png", "times.svg", "--json"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const json s = json::parse(simulated.out);
  const double recorded = s["recorded"]["residual_rms_nm"], machine_rms = s["program"]["residual_rms_nm"];
  EXPECT_NEAR(recorded, machine_rms, 0.02 * recorded);
  EXPECT_LT(s["recorded"]["removal_change_rms_nm"].get<double>(), 0.03 * recorded);
  EXPECT_GT(recorded, 1.3 * s["executed"]["commanded_rms_nm"].get<double>());
  EXPECT_NEAR(s["recorded"]["total_s"].get<double>(), s["recorded"]["machine_s"].get<double>(), 0.05);
  EXPECT_GT(s["recorded"]["total_s"].get<double>(), 1.05 * s["recorded"]["commanded_s"].get<double>());
  expect_has(read_whole_file(inputs / "times.svg"), "<svg");
  const ProgramResult text = inputs.run({"simulate", "plan", "--log", "run.csv"});
  ASSERT_EQ(text.exit_code, 0) << text.err;
  expect_has(text.out, "          commanded ");
  expect_has(text.out, "          recorded  ");
}

TEST(MachineFitCommand, RefusesWhatItCannotUse) {
  const LoggedPlan inputs;
  const auto refused = [&inputs](const Words& words, const std::string& part) {
    const ProgramResult result = inputs.run(words);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    expect_has(result.err, part);
  };
  refused({"machine", "fit"}, "LOG: required");
  refused({"machine", "fit", "run.csv"}, "--program: required");
  refused({"machine", "fit", "none.csv", "--program", "plan/program.nc"}, "none.csv");
  refused(with(kFit, {"--out", "m.csv"}), "--out 'm.csv': extension '.csv'; accepted: .toml");
  refused(with(kFit, {"--log-columns", "x"}), "--log-columns = \"x\"; accepted: ");
  refused(with(kFit, {"--log-period", "-1"}), "--log-period: '-1'; required a number from ");
  refused(with(kFit, {"--log-period", "0.001"}), "but --log-period is given as well");
  refused(with(kFit, {"--log-columns", "t_ms:s,x_um,y_mm"}), "they must agree");
  refused(with(kFit, {"--log-tolerance", "0"}), "--log-tolerance: '0'; required ");
  inputs.folder.file("mm.csv", test::log_text(inputs.log(), "t_ms,x_mm,y_mm", 1e-3));
  refused({"machine", "fit", "mm.csv", "--program", "plan/program.nc"},
          "mm.csv: no log of this path (--log-tolerance 0.1 mm)");
  refused({"simulate", "plan", "--log", "mm.csv"}, "mm.csv: no log of this path");
  refused({"simulate", "plan", "--log-period", "0.001"}, "--log-period: of a log; --log FILE is required");
  refused({"simulate", "plan", "--log-png", "a.png"}, "--log-png: of a log; --log FILE is required");
  refused({"simulate", "plan", "--log", "run.csv", "--log-png", "a.csv"}, "--log-png 'a.csv': extension");
}

}  // namespace
}  // namespace dwell
