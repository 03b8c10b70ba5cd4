/// Motions whose steps take longer than a machine's, and the strokes of a program that was read back.

#include "paths/feed/late_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "paths/feed/plan_program.h"

namespace dwell {
namespace {

ToolPath bent_path() {
  ToolPath path;
  path.points = {{0.0, 0.0}, {2.0, 0.5}, {3.0, 3.0}, {1.0, 4.0}, {6.0, 4.5}, {7.0, 2.0}};
  path.lifted = {0, 0, 0, 0, 1, 0};
  return path;
}

Machine weak_machine() {
  Machine machine;
  machine.path_acceleration = 30.0;
  machine.corner_delay = 0.02;
  machine.lift = {0.5, 0.3, 0.1};
  return machine;
}

TEST(LateMotion, GivesEveryStepItsTimeAndLeavesEveryPlace) {
  const Program program = program_of(bent_path(), {0.7, 0.4, 0.9, 0.5, 0.6, 0.8}, Motion::Moving, 20.0);
  const Execution run = execute(program, weak_machine());
  std::vector<double> late(program.steps.size(), 0.0);
  for (std::size_t i = 0; i < late.size(); ++i) {
    if (program.steps[i].removes) late[i] = 0.01 * static_cast<double>(i + 1) - 0.03;
  }
  const Program motion = late_motion(run, late);
  ASSERT_EQ(motion.steps.size(), run.motion.steps.size());
  ASSERT_EQ(run.at_lifts.size(), 5U);  // down and settling at the beginning, up, down and settling at the lift
  double begin = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < late.size(); ++i) sum += run.seconds[i] + late[i];
  for (const std::size_t k : run.at_lifts) sum += run.motion.steps[k].seconds;
  EXPECT_NEAR(motion.total_seconds(), sum, 1e-12);
  // By hand: the time of every piece is stretched as the step is in which its middle lies. A rest at a corner is half
  // of the step before and half of the one after.
  for (std::size_t k = 0; k < motion.steps.size(); ++k) {
    const ProgramStep &now = motion.steps[k], &then = run.motion.steps[k];
    EXPECT_EQ(now.start, then.start);
    EXPECT_EQ(now.finish, then.finish);
    if (std::find(run.at_lifts.begin(), run.at_lifts.end(), k) != run.at_lifts.end()) {
      EXPECT_EQ(now.seconds, then.seconds);
      continue;
    }
    const bool rests = then.start == then.finish;
    const auto factor_at = [&](double t) {
      double until = 0.0;
      for (std::size_t i = 0; i < late.size(); ++i) {
        until += run.seconds[i];
        if (t < until) return 1.0 + late[i] / run.seconds[i];
      }
      return 1.0;
    };
    const double expected =
        rests ? 0.5 * then.seconds * (factor_at(begin + 0.25 * then.seconds) + factor_at(begin + 0.75 * then.seconds))
              : then.seconds * factor_at(begin + 0.5 * then.seconds);
    EXPECT_NEAR(now.seconds, expected, 1e-12) << k;
    begin += then.seconds;
  }
}

TEST(LateMotion, FindsTheStrokesOfAProgramWithoutItsEmptyHalts) {
  const StrokeMoves moves = stroke_moves(bent_path(), Motion::Moving);
  Program program = program_of(bent_path(), {0.7, 0.4, 0.9, 0.5, 0.6, 0.8}, Motion::Moving, 20.0);
  program.steps.front().start.x += 8e-7;  // as files round
  const std::vector<Index> stroke = strokes_of_steps(program, moves);
  ASSERT_EQ(stroke.size(), program.steps.size());
  std::vector<double> seconds;
  for (const ProgramStep& step : program.steps) seconds.push_back(step.seconds);
  const Eigen::VectorXd sums = sum_of_strokes(stroke, seconds, moves.strokes);
  const double dwell[] = {0.7, 0.4, 0.9, 0.5, 0.6, 0.8};
  for (Index j = 0; j < 6; ++j) EXPECT_NEAR(sums[j], dwell[j], 1e-12) << j;
  const Eigen::VectorXd late = Eigen::VectorXd::LinSpaced(6, -0.1, 0.2);
  const Eigen::VectorXd back = sum_of_strokes(stroke, late_of_steps(stroke, seconds, late), 6);
  EXPECT_LT((back - late).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(LateMotion, RefusesAProgramOfAnotherPath) {
  const StrokeMoves moves = stroke_moves(bent_path(), Motion::Moving);
  Program program = program_of(bent_path(), {0.7, 0.4, 0.9, 0.5, 0.6, 0.8}, Motion::Moving, 20.0);
  program.file = "other.nc";
  Program longer = program, shorter = program;
  longer.steps.push_back(longer.steps.back());
  shorter.steps.pop_back();
  program.steps[3].finish.y += 1e-3;
  for (const Program& wrong : {program, longer, shorter}) {
    try {
      strokes_of_steps(wrong, moves);
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("other.nc: "), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("not of the path"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace dwell
