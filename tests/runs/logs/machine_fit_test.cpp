#include "runs/logs/machine_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/errors.h"
#include "runs/logs/log_alignment.h"
#include "tests/runs/logs/made_up_log.h"

namespace dwell {
namespace {

using test::crooked_program;
using test::LogMaking;
using test::made_up_log;

MachineFit fit_of(const Program& program, const Machine& machine, const LogMaking& making = {},
                  const Machine& start = {}) {
  const MotionLog log = made_up_log(program, machine, making);
  return fit_machine(align_log(log, program), program, start);
}

const FittedFigure* find(const MachineFit& fit, const std::string& key) {
  const auto at = std::find_if(fit.fitted.begin(), fit.fitted.end(), [&](const auto& f) { return f.key == key; });
  return at == fit.fitted.end() ? nullptr : &*at;
}

bool is_undetermined(const MachineFit& fit, const std::string& name) {
  return std::any_of(fit.undetermined.begin(), fit.undetermined.end(), [&](const auto& u) { return u.name == name; });
}

/// The truth lies within four standard errors and a part of itself, and the standard error says something.
void expect_figure(const MachineFit& fit, const std::string& key, double truth, double part = 0.0) {
  const FittedFigure* figure = find(fit, key);
  ASSERT_NE(figure, nullptr) << key;
  EXPECT_NEAR(figure->value, truth, 4.0 * figure->error + part * std::abs(truth)) << key << " +- " << figure->error;
  EXPECT_LT(figure->error, 0.05 * std::abs(truth)) << key;
  EXPECT_GT(figure->error, 0.0) << key;
}

Machine stopping_machine() {
  Machine machine;
  machine.path_acceleration = 120.0;
  machine.corner_delay = 0.003;
  return machine;
}

TEST(MachineFit, FindsAccelerationAndDelayAtCorners) {
  LogMaking making;
  making.noise = 1e-4;
  const MachineFit fit = fit_of(crooked_program(5, 400), stopping_machine(), making);
  expect_figure(fit, "path_acceleration", 120.0);
  expect_figure(fit, "corner_delay", 0.003);
  expect_figure(fit, "clock_scale", 1.0);
  EXPECT_EQ(fit.machine.path_acceleration, find(fit, "path_acceleration")->value);
  EXPECT_EQ(fit.machine.corner_delay, find(fit, "corner_delay")->value);
  EXPECT_EQ(fit.machine.corner, CornerRule::ExactStop);
  EXPECT_TRUE(std::isinf(fit.machine.max_feed));
  EXPECT_TRUE(is_undetermined(fit, "speed limit along the path"));
  EXPECT_TRUE(is_undetermined(fit, "following lag"));
  EXPECT_TRUE(is_undetermined(fit, "acceleration of each axis"));
  EXPECT_GT(find(fit, "path_acceleration")->explained, 0.5);
  EXPECT_LT(fit.rms, 5e-4);
  EXPECT_GT(fit.commanded_rms, 0.02);
  EXPECT_NEAR(fit.modelled, fit.logged, 1e-3);
  EXPECT_GT(fit.logged, fit.commanded + 1.0);
  EXPECT_LE(fit.runs, 398u);
  EXPECT_GT(fit.runs, 380u);
}

// Controllers end a run at the next tick of their servo clock: half a tick more, on average.
TEST(MachineFit, BearsRunsThatEndAtServoTicks) {
  LogMaking making;
  making.servo = 1e-3;
  const MachineFit fit = fit_of(crooked_program(6, 600), stopping_machine(), making);
  expect_figure(fit, "path_acceleration", 120.0, 0.005);
  const FittedFigure* delay = find(fit, "corner_delay");
  ASSERT_NE(delay, nullptr);
  EXPECT_NEAR(delay->value, 0.0035, 1e-4);
  EXPECT_NEAR(fit.rms, 1e-3 / std::sqrt(12.0), 1e-4);
}

TEST(MachineFit, TellsAxesApart) {
  Machine machine;
  machine.x.max_acceleration = 60.0;
  machine.y.max_acceleration = 200.0;
  machine.corner_delay = 0.002;
  LogMaking making;
  making.noise = 1e-4;
  Machine start;
  start.path_acceleration = 77.0;
  start.x.lowest = -400.0;
  const MachineFit fit = fit_of(crooked_program(7, 500), machine, making, start);
  expect_figure(fit, "x_acceleration", 60.0);
  expect_figure(fit, "y_acceleration", 200.0);
  expect_figure(fit, "corner_delay", 0.002);
  EXPECT_EQ(find(fit, "path_acceleration"), nullptr);
  EXPECT_TRUE(std::isinf(fit.machine.path_acceleration));  // the start's would bind as well
  EXPECT_EQ(fit.machine.x.lowest, -400.0);
}

TEST(MachineFit, FindsASpeedLimitThatIsReached) {
  Machine machine = stopping_machine();
  machine.path_acceleration = 900.0;
  machine.max_feed = 11.0;
  const MachineFit fit = fit_of(crooked_program(8, 400), machine);
  expect_figure(fit, "max_feed", 11.0, 1e-3);
  expect_figure(fit, "path_acceleration", 900.0, 0.02);  // a stop from the limit has but a dozen samples
  EXPECT_FALSE(is_undetermined(fit, "speed limit along the path"));
}

TEST(MachineFit, FindsTheCornerRule) {
  Machine machine;
  machine.path_acceleration = 120.0;
  machine.corner = CornerRule::JunctionDeviation;
  machine.junction_deviation = 0.02;
  const Program program = crooked_program(9, 500);
  const MachineFit rounding = fit_of(program, machine);
  EXPECT_EQ(rounding.machine.corner, CornerRule::JunctionDeviation);
  expect_figure(rounding, "junction_deviation", 0.02, 0.01);
  expect_figure(rounding, "path_acceleration", 120.0, 0.01);
  machine.corner = CornerRule::Free;
  const MachineFit free = fit_of(program, machine);
  EXPECT_EQ(free.machine.corner, CornerRule::Free);
  // A program that says its path mode leaves no rule to be found: the machine stops.
  Program exact = program;
  exact.path_modes.push_back({0, {PathMode::Kind::ExactPath}});
  const MachineFit said = fit_of(exact, machine, {}, machine);
  EXPECT_EQ(said.machine.corner, CornerRule::Free);
  EXPECT_TRUE(is_undetermined(said, "corner rule"));
  expect_figure(said, "path_acceleration", 120.0, 0.01);
}

TEST(MachineFit, FindsAClockThatIsOffAndABlockDelay) {
  LogMaking making;
  making.clock = 1.02;
  making.noise = 1e-4;
  // Straight on in places, so that runs have one block or several.
  Program program = crooked_program(10, 400);
  std::vector<ProgramStep> steps;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const ProgramStep& s = program.steps[i];
    const std::size_t parts = 1 + i % 3;
    for (std::size_t k = 0; k < parts; ++k) {
      const auto at = [&](std::size_t j) {
        return s.start + (static_cast<double>(j) / static_cast<double>(parts)) * (s.finish - s.start);
      };
      steps.push_back({at(k), at(k + 1), s.seconds / static_cast<double>(parts)});
    }
  }
  program.steps = steps;
  const MachineFit fit = fit_of(program, stopping_machine(), making);
  expect_figure(fit, "clock_scale", 1.02, 1e-4);
  expect_figure(fit, "path_acceleration", 120.0, 0.01);
  ASSERT_EQ(fit.notes.size(), 2u);
  EXPECT_NE(fit.notes[1].find("taken out of what is written"), std::string::npos) << fit.notes[1];
  making.clock = 1.0;
  making.block = 0.0015;
  const MachineFit blocks = fit_of(program, stopping_machine(), making);
  expect_figure(blocks, "block_delay", 0.0015, 0.05);
  EXPECT_FALSE(find(blocks, "block_delay")->written);
  EXPECT_NE(blocks.notes.back().find("a block would explain more"), std::string::npos);
}

TEST(MachineFit, LeavesWhatTheLogDoesNotDetermineAsItWas) {
  Machine machine;  // accelerates as if it had no mass
  machine.path_acceleration = 1e7;
  machine.corner_delay = 0.02;
  Machine start;
  start.path_acceleration = 3e6;
  start.max_feed = 44.0;
  const MachineFit fit = fit_of(crooked_program(11, 100), machine, {}, start);
  EXPECT_TRUE(is_undetermined(fit, "acceleration along the path"));
  EXPECT_EQ(fit.machine.path_acceleration, 3e6);
  EXPECT_EQ(fit.machine.max_feed, 44.0);
  expect_figure(fit, "corner_delay", 0.02);
  EXPECT_TRUE(is_undetermined(fit, "delay a block"));  // every run is one block
  // What the log contradicts does not stay.
  start.path_acceleration = 100.0;
  start.max_feed = 7.0;
  const MachineFit freed = fit_of(crooked_program(11, 100), machine, {}, start);
  EXPECT_TRUE(std::isinf(freed.machine.path_acceleration));
  EXPECT_TRUE(std::isinf(freed.machine.max_feed));
  expect_figure(freed, "corner_delay", 0.02);
  EXPECT_EQ(freed.notes.size(), 3u);
}

TEST(MachineFit, LeavesOutRunsWithMissingSamplesAndFarOffOnes) {
  const Program program = crooked_program(12, 200);
  MotionLog log = made_up_log(program, stopping_machine());
  for (std::size_t i = log.size() / 3; i < log.size(); ++i) log.seconds[i] += 0.7;  // the controller was held up
  log.gaps.push_back(log.size() / 2);
  const MachineFit fit = fit_machine(align_log(log, program), program, {});
  EXPECT_GE(fit.outliers, 1u);
  EXPECT_LE(fit.outliers, 10u);
  EXPECT_GE(fit.gaps, 1u);
  expect_figure(fit, "path_acceleration", 120.0, 0.01);
}

TEST(MachineFit, RefusesTooFewRunsAndProgramsThatSayTheirSpeeds) {
  const Program few = crooked_program(5, 9);
  try {
    fit_of(few, stopping_machine());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("7 runs from corner to corner can be fitted"), std::string::npos)
        << error.what();
  }
  Program speeds = crooked_program(5, 40);
  const AlignedLog aligned = align_log(made_up_log(speeds, stopping_machine()), speeds);
  speeds.steps[3].speeds = EndSpeeds{};
  EXPECT_THROW(fit_machine(aligned, speeds, {}), InputError);
}

TEST(MachineFit, IsStoppedWhenAskedTo) {
  const Program program = crooked_program(5, 100);
  const AlignedLog aligned = align_log(made_up_log(program, stopping_machine()), program);
  Progress progress;
  int asked = 0;
  progress.stop = [&asked] { return ++asked > 5; };
  EXPECT_THROW(fit_machine(aligned, program, {}, progress), Interrupted);
}

TEST(MachineFit, WritesAFileThatReadsBack) {
  const MachineFit fit = fit_of(crooked_program(5, 100), stopping_machine());
  const NamedMachine read = parse_machine(fitted_machine_text(fit, "mine", "run\n.csv"), "m.toml");
  EXPECT_EQ(read.name, "mine");
  EXPECT_EQ(read.machine.path_acceleration, fit.machine.path_acceleration);
  EXPECT_EQ(read.machine.corner_delay, fit.machine.corner_delay);
}

}  // namespace
}  // namespace dwell
