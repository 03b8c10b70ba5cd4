#include "paths/feed/constant_schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "paths/feed/execution.h"
#include "paths/feed/least_dwell.h"
#include "tests/paths/feed/motion_oracle.h"

namespace dwell {
namespace {

/// Lines to and fro with turns, a lift, and one part that turns at every point; without symmetry.
ToolPath lines_and_corners() {
  ToolPath path{"file", {}, {}};
  for (int line = 0; line < 4; ++line) {
    for (int k = 0; k < 9; ++k)
      path.points.push_back({line % 2 == 0 ? 0.6 * k : 0.6 * (8 - k), 0.9 * line + 0.02 * line * line});
  }
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::size_t lifted = path.points.size();
  for (int k = 0; k < 12; ++k) path.points.push_back({7.0 + unit(random) + 0.4 * k, 3.0 * unit(random)});
  path.lifted.assign(path.points.size(), 0);
  path.lifted[0] = path.lifted[lifted] = 1;
  return path;
}

Machine small_machine(CornerRule rule) {
  Machine machine;
  machine.x = {.max_speed = 30.0, .max_acceleration = 60.0};
  machine.y = {.max_speed = 25.0, .max_acceleration = 90.0};
  machine.max_feed = 20.0;
  machine.corner = rule;
  machine.blend_tolerance = 0.07;
  machine.across_share = 0.8;
  machine.along_share = 0.6;
  machine.corner_delay = rule == CornerRule::ExactStop ? 0.004 : 0.0;
  return machine;
}

struct Case {
  StrokeMoves moves;
  KinematicPath path;
  Eigen::VectorXd least;
};

Case laid(const Machine& machine) {
  Case c;
  c.moves = stroke_moves(lines_and_corners(), Motion::Moving);
  c.path = kinematic_path(c.moves.steps, machine);
  c.least = least_dwell(c.moves, c.path, machine);
  return c;
}

/// The program that commands the feeds.
Program commanded(const StrokeMoves& moves, const std::vector<double>& feed) {
  Program program;
  program.steps = moves.steps;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves.stroke[i] == StrokeMoves::kNoStroke) continue;
    program.steps[i].seconds = program.steps[i].length() / feed[static_cast<std::size_t>(moves.stroke[i])];
  }
  return program;
}

Eigen::VectorXd executed(const StrokeMoves& moves, const Program& program, const Machine& machine) {
  const Execution run = execute(program, machine);
  Eigen::VectorXd seconds = Eigen::VectorXd::Zero(moves.strokes);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves.stroke[i] != StrokeMoves::kNoStroke) seconds[moves.stroke[i]] += run.seconds[i];
  }
  return seconds;
}

TEST(LeastDwell, IsTheTimeOfAMachineThatRunsAsFastAsItCan) {
  for (const CornerRule rule :
       {CornerRule::ExactStop, CornerRule::JunctionDeviation, CornerRule::Free, CornerRule::Blend}) {
    const Machine machine = small_machine(rule);
    const Case c = laid(machine);
    const Eigen::VectorXd fastest = executed(
        c.moves, commanded(c.moves, std::vector<double>(static_cast<std::size_t>(c.moves.strokes), 1e6)), machine);
    EXPECT_LE((fastest - c.least).cwiseAbs().maxCoeff(), 1e-12) << to_string(rule);
    EXPECT_GT(c.least.minCoeff(), 0.0);
  }
}

TEST(ConstantSchedule, IsExecutedInTheTimesOfThePlan) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const CornerRule rule :
       {CornerRule::ExactStop, CornerRule::JunctionDeviation, CornerRule::Free, CornerRule::Blend}) {
    const Machine machine = small_machine(rule);
    const Case c = laid(machine);
    // Times that the machine can run, since it would with these feeds.
    std::vector<double> some(static_cast<std::size_t>(c.moves.strokes));
    for (std::size_t j = 0; j < some.size(); ++j) some[j] = 3.0 + std::sin(0.7 * static_cast<double>(j)) + unit(random);
    const Eigen::VectorXd dwell = executed(c.moves, commanded(c.moves, some), machine);
    const ConstantSchedule schedule = schedule_constant(c.moves, c.path, machine, dwell);
    EXPECT_EQ(schedule.too_short, 0) << to_string(rule);
    EXPECT_LE(schedule.worst_error, 1e-8) << to_string(rule) << schedule.rounds;
    const Eigen::VectorXd taken = executed(c.moves, commanded(c.moves, schedule.feed), machine);
    EXPECT_LE((taken - dwell).cwiseQuotient(dwell).cwiseAbs().maxCoeff(), 1e-8) << to_string(rule);
    EXPECT_LE((taken - schedule.seconds).cwiseAbs().maxCoeff(), 1e-9);
    // Feeds of dwell and length alone would be off by much.
    std::vector<double> naive(schedule.feed.size());
    const std::vector<Stroke> strokes = moving_strokes(lines_and_corners());
    for (std::size_t j = 0; j < naive.size(); ++j) naive[j] = strokes[j].length() / dwell[static_cast<Index>(j)];
    const Eigen::VectorXd off = executed(c.moves, commanded(c.moves, naive), machine);
    if (rule == CornerRule::ExactStop) {
      EXPECT_GT((off - dwell).cwiseQuotient(dwell).maxCoeff(), 0.1);
    }
  }
}

// Where the arcs are as large as the feeds need, the feeds decide the path that they are made for.
TEST(ConstantSchedule, FindsFeedsAndTheArcsThatTheyNeedTogether) {
  Machine machine = small_machine(CornerRule::Blend);
  machine.blend_size = BlendSize::AsNeeded;
  const Case c = laid(machine);
  std::vector<double> some(static_cast<std::size_t>(c.moves.strokes));
  for (std::size_t j = 0; j < some.size(); ++j) some[j] = 2.0 + std::sin(0.7 * static_cast<double>(j));
  const Eigen::VectorXd dwell = executed(c.moves, commanded(c.moves, some), machine);
  const ConstantSchedule once = schedule_constant(c.moves, c.path, machine, dwell);
  const Eigen::VectorXd off = executed(c.moves, commanded(c.moves, once.feed), machine);
  EXPECT_GT((off - dwell).cwiseQuotient(dwell).cwiseAbs().maxCoeff(), 5e-3);
  const ConstantSchedule schedule = schedule_blended(c.moves, machine, 20.0, dwell);
  const Eigen::VectorXd taken = executed(c.moves, commanded(c.moves, schedule.feed), machine);
  EXPECT_LE((taken - dwell).cwiseQuotient(dwell).cwiseAbs().maxCoeff(), 1e-5);
  machine.blend_size = BlendSize::Largest;
  const ConstantSchedule fixed = schedule_blended(c.moves, machine, 20.0, dwell);
  EXPECT_EQ(fixed.feed, schedule_constant(c.moves, kinematic_path(c.moves.steps, machine, 20.0), machine, dwell).feed);
}

TEST(ConstantSchedule, CountsStrokesThatTheMachineCannotRunInTime) {
  const Machine machine = small_machine(CornerRule::ExactStop);
  const Case c = laid(machine);
  Eigen::VectorXd dwell = 3.0 * c.least;
  dwell[14] = 0.4 * c.least[14];
  const ConstantSchedule schedule = schedule_constant(c.moves, c.path, machine, dwell);
  EXPECT_GE(schedule.too_short, 1);
  EXPECT_GT(schedule.seconds[14], dwell[14]);
}

TEST(ConstantSchedule, IsLengthOverDwellWithoutLimits) {
  const Machine machine{.max_feed = 100.0, .corner = CornerRule::Free};
  const Case c = laid(machine);
  Eigen::VectorXd dwell = Eigen::VectorXd::LinSpaced(c.moves.strokes, 0.1, 0.9);
  const ConstantSchedule schedule = schedule_constant(c.moves, c.path, machine, dwell);
  const std::vector<Stroke> strokes = moving_strokes(lines_and_corners());
  for (std::size_t j = 0; j < strokes.size(); ++j)
    EXPECT_NEAR(schedule.feed[j], strokes[j].length() / dwell[static_cast<Index>(j)], 1e-9);
}

}  // namespace
}  // namespace dwell
