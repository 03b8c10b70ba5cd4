#include "paths/feed/execution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/cubic_move.h"
#include "core/removal/simulate.h"
#include "core/tif/removal_function.h"
#include "paths/feed/kinematic_path.h"
#include "tests/paths/feed/motion_oracle.h"

namespace dwell {
namespace {

using test::crooked_chain;
using test::SpeedOracle;

constexpr double kAcceleration = 20.0;

Machine machine_with(CornerRule corner) {
  Machine machine;
  machine.path_acceleration = kAcceleration;
  machine.max_feed = 100.0;
  machine.corner = corner;
  machine.junction_deviation = 0.03;
  return machine;
}

/// What Jeon's rule gives for two moves, from the vectors.
double junction(const ProgramStep& a, const ProgramStep& b, double deviation) {
  const Point u = (1.0 / a.length()) * (a.finish - a.start), w = (1.0 / b.length()) * (b.finish - b.start);
  const double half = std::sqrt(0.5 * (1.0 + dot(u, w)));  // sine of half the angle between the moves
  return kAcceleration * deviation * half / (1.0 - half);
}

std::vector<double> corners(const std::vector<ProgramStep>& steps, CornerRule rule) {
  std::vector<double> caps(steps.size() + 1, 0.0);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (rule == CornerRule::JunctionDeviation) caps[i] = junction(steps[i - 1], steps[i], 0.03);
    if (rule == CornerRule::Free) caps[i] = INFINITY;
  }
  return caps;
}

class ExecutionOf : public testing::TestWithParam<CornerRule> {};

TEST_P(ExecutionOf, ACrookedChainTakesTheOraclesTimes) {
  const Program program{"", crooked_chain(3, 40, 0.5, 12.0)};
  const Execution run = execute(program, machine_with(GetParam()));
  const SpeedOracle oracle(program.steps, kAcceleration, corners(program.steps, GetParam()));
  ASSERT_EQ(run.seconds.size(), program.steps.size());
  for (std::size_t i = 0; i < program.steps.size(); ++i)
    EXPECT_NEAR(run.seconds[i], oracle.seconds(i), 1e-3 * oracle.seconds(i)) << i;
  double total = 0.0;
  for (const double seconds : run.seconds) total += seconds;
  EXPECT_NEAR(run.motion.total_seconds(), total, 1e-9 * total);
  EXPECT_GT(total, 1.02 * program.total_seconds());  // or there would be nothing to tell
}

/// Removal by steps of time: the tool's place every 0.1 ms, from the oracle's speed.
std::vector<double> stepped_removal(const Program& program, const SpeedOracle& oracle, const RemovalFunction& tool,
                                    const HeightMap& map) {
  std::vector<double> removal(map.values.size(), 0.0);
  constexpr double kStep = 1e-4;
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const ProgramStep& step = program.steps[i];
    double s = 0.0;
    while (s < step.length()) {
      // Half a step on, at the speed that it has there; from rest a least way.
      const double v = std::sqrt(oracle.squared_speed(oracle.begin_of(i) + s));
      const double ahead = std::max(s + 0.5 * kStep * v, s + 1e-7);
      const double mean = std::sqrt(oracle.squared_speed(oracle.begin_of(i) + std::min(ahead, step.length())));
      const double next = std::min(step.length(), s + std::max(kStep * mean, 1e-6));
      const Point at = step.start + (0.5 * (s + next) / step.length()) * (step.finish - step.start);
      const double seconds = (next - s) / std::sqrt(oracle.squared_speed(oracle.begin_of(i) + 0.5 * (s + next)));
      for (std::size_t k = 0; k < removal.size(); ++k) {
        const Point d = map.grid.centre(static_cast<Index>(k)) - at;
        const double r2 = dot(d, d);
        if (r2 < tool.radius * tool.radius) removal[k] += seconds * std::exp(-0.5 * r2 / (tool.sigma * tool.sigma));
      }
      s = next;
    }
  }
  return removal;
}

TEST_P(ExecutionOf, ACrookedChainRemovesWhatStepsOfTimeRemove) {
  const Program program{"", crooked_chain(8, 12, 0.5, 8.0)};
  const Execution run = execute(program, machine_with(GetParam()));
  const RemovalFunction tool = gaussian_removal(1.0, 1.2, 3.0);
  HeightMap map(Grid{24, 30, 0.3, 0.25, {-4.0, -1.0}});
  for (double& z : map.values) z = 0.0;
  const HeightMap removal = simulate(run.motion, map, removal_kernel(tool, map.grid.pitch_x, map.grid.pitch_y), 1);
  const HeightMap commanded = simulate(program, map, removal_kernel(tool, map.grid.pitch_x, map.grid.pitch_y), 1);
  const std::vector<double> expected = stepped_removal(
      program, SpeedOracle(program.steps, kAcceleration, corners(program.steps, GetParam())), tool, map);
  double most = 0.0, off = 0.0, naive = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    most = std::max(most, expected[k]);
    off = std::max(off, std::abs(removal.values[k] - expected[k]));
    naive = std::max(naive, std::abs(commanded.values[k] - expected[k]));
  }
  EXPECT_LE(off, 2e-3 * most);
  EXPECT_GE(naive, 0.02 * most);  // the commanded speeds would be far off
}

INSTANTIATE_TEST_SUITE_P(Rules, ExecutionOf,
                         testing::Values(CornerRule::ExactStop, CornerRule::JunctionDeviation, CornerRule::Free));

TEST(Execution, RunsAtTheFeedWhereNothingHoldsItBack) {
  const Program program{"", crooked_chain(5, 30, 2.0, 9.0)};
  const Execution run = execute(program, Machine{.corner = CornerRule::Free});
  ASSERT_EQ(run.motion.steps.size(), program.steps.size());
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    EXPECT_EQ(run.motion.steps[i].finish, program.steps[i].finish);
    EXPECT_NEAR(run.motion.steps[i].seconds, program.steps[i].seconds, 1e-12);
  }
}

TEST(Execution, RestsAtCornersForTheMachinesDelay) {
  const Program program{"", {{{0, 0}, {4, 0}, 1.0, true}, {{4, 0}, {8, 0}, 1.0, true}, {{8, 0}, {8, 4}, 1.0, true}}};
  Machine machine = machine_with(CornerRule::ExactStop);
  const double without = execute(program, machine).motion.total_seconds();
  machine.corner_delay = 0.01;
  const Execution run = execute(program, machine);
  EXPECT_NEAR(run.motion.total_seconds(), without + 0.01, 1e-12);  // one corner; straight on is none
  EXPECT_NEAR(run.seconds[1] + run.seconds[2] - execute(program, machine_with(CornerRule::ExactStop)).seconds[1] -
                  execute(program, machine_with(CornerRule::ExactStop)).seconds[2],
              0.01, 1e-12);
}

TEST(Execution, KeepsHaltsAndLiftsAndGivesRapidsTheirTime) {
  Machine machine = machine_with(CornerRule::Free);
  machine.path_acceleration = INFINITY;
  machine.max_feed = 20.0;
  const Program program{"", {{{0, 0}, {0, 0}, 0.7, true}, {{0, 0}, {5, 0}, 0.0, false}, {{5, 0}, {6, 0}, 0.5, true}}};
  const Execution run = execute(program, machine);
  ASSERT_EQ(run.motion.steps.size(), 3U);
  EXPECT_EQ(run.motion.steps[0].seconds, 0.7);
  EXPECT_DOUBLE_EQ(run.motion.steps[1].seconds, 0.25);
  EXPECT_FALSE(run.motion.steps[1].removes);
  EXPECT_DOUBLE_EQ(run.motion.steps[2].seconds, 0.5);
}

TEST(Execution, TakesThePathModeOfTheProgramBeforeTheMachinesRule) {
  const Machine free = machine_with(CornerRule::Free);
  Program program{"p.nc", {{{0, 0}, {4, 0}, 1.0, true}, {{4, 0}, {8, 0}, 1.0, true}, {{8, 0}, {8, 4}, 1.0, true}}};
  const double none = execute(program, free).motion.total_seconds();
  program.path_modes = {{0, {PathMode::Kind::ExactPath}}};
  const double corner = execute(program, free).motion.total_seconds();
  // A stop from 4 mm/s and start again: 4 / 20 s each, over 0.4 mm each that would take 0.1 s.
  EXPECT_NEAR(corner, none + 0.2, 1e-12);
  program.path_modes = {{0, {PathMode::Kind::ExactStop}}};
  EXPECT_NEAR(execute(program, free).motion.total_seconds(), none + 0.4, 1e-12);
  program.path_modes = {{1, {PathMode::Kind::ExactStop}}};  // the end of the first move is free still
  EXPECT_NEAR(execute(program, free).motion.total_seconds(), none + 0.2, 1e-12);
}

TEST(Execution, LeavesTheWayUpToTheRapidLength) {
  Machine machine = machine_with(CornerRule::Free);
  machine.path_acceleration = INFINITY;
  machine.max_feed = 20.0;
  Program program{"", {{{0, 0}, {1, 0}, 0.5, true}, {{1, 0}, {6, 0}, 0.0, false}, {{6, 0}, {7, 0}, 0.5, true}}};
  program.rapid_length = 5.0 + 10.0;
  program.fastest_feed = 2.0;
  EXPECT_NEAR(execute(program, machine).motion.run_seconds(), 0.5 + 0.25 + 0.5 + 0.5, 1e-12);
  EXPECT_NEAR(execute(program, Machine{}).motion.run_seconds(), 0.5 + 2.5 + 0.5 + 5.0, 1e-12);
}

// Straight at constant acceleration from node to node, in the times and at the places of the motion itself.
TEST_P(ExecutionOf, ItsNodesAreItsMotion) {
  Machine machine = machine_with(GetParam());
  machine.corner_delay = 0.013;
  const Program program{"", crooked_chain(6, 30, 0.5, 10.0)};
  const Execution run = execute(program, machine);
  const std::vector<MotionNode> nodes = motion_nodes(program, machine);
  ASSERT_GT(nodes.size(), program.steps.size());
  EXPECT_EQ(nodes.front().place, program.steps.front().start);
  EXPECT_NEAR(distance(nodes.back().place, program.steps.back().finish), 0.0, 1e-9);
  EXPECT_NEAR(nodes.back().seconds, run.motion.total_seconds(), 1e-9);
  double clock = 0.0;
  std::size_t next = 1;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const MotionNode &a = nodes[i - 1], &b = nodes[i];
    const double seconds = b.seconds - a.seconds, way = distance(a.place, b.place);
    if (seconds == 0.0) continue;  // a jump of the speed
    EXPECT_NEAR(way, 0.5 * (a.speed + b.speed) * seconds, 1e-9) << i;
    EXPECT_LE(std::abs(b.speed - a.speed), kAcceleration * seconds * (1.0 + 1e-6) + 1e-9) << i;
  }
  for (const ProgramStep& step : run.motion.steps) {  // each begins and ends on a stretch of the nodes, in its time
    clock += step.seconds;
    while (next + 1 < nodes.size() && nodes[next].seconds < clock - 1e-9) ++next;
    const MotionNode &a = nodes[next - 1], &b = nodes[next];
    const double t = clock - a.seconds, whole = b.seconds - a.seconds;
    const double share = whole > 0.0 ? t / whole : 1.0, length = distance(a.place, b.place);
    const double way = a.speed * t + 0.5 * (b.speed - a.speed) * share * t;
    const Point place = length > 0.0 ? a.place + (way / length) * (b.place - a.place) : b.place;
    EXPECT_NEAR(distance(place, step.finish), 0.0, 1e-8) << "at " << clock << " s";
  }
}

TEST(MotionNodes, HaveTwoOfOneTimeWhereTheSpeedJumps) {
  Machine machine = machine_with(CornerRule::Free);
  machine.path_acceleration = INFINITY;
  machine.max_feed = 20.0;
  const Program program{"", {{{0, 0}, {0, 0}, 0.7, true}, {{0, 0}, {5, 0}, 0.0, false}, {{5, 0}, {6, 0}, 0.5, true}}};
  const std::vector<MotionNode> nodes = motion_nodes(program, machine);
  ASSERT_EQ(nodes.size(), 6U);
  EXPECT_DOUBLE_EQ(nodes[1].seconds, 0.7);
  EXPECT_TRUE(nodes[1].removes);
  EXPECT_EQ(nodes[2].seconds, nodes[1].seconds);
  EXPECT_DOUBLE_EQ(nodes[2].speed, 20.0);
  EXPECT_FALSE(nodes[3].removes);
  EXPECT_DOUBLE_EQ(nodes[3].seconds, 0.95);
  EXPECT_DOUBLE_EQ(nodes[4].speed, 2.0);
  EXPECT_DOUBLE_EQ(nodes[5].seconds, 1.45);
}

// A program that says its speeds has a cubic for every step.
TEST(MotionNodes, FollowTheCubicsOfAProgramThatSaysItsSpeeds) {
  ProgramStep turn{{0, 0}, {3, 1}, 2.0, true, EndSpeeds{{2.0, 0.0}, {0.5, 1.5}}};
  const Program program{"", {turn, {{3, 1}, {3, 1}, 0.25, true}}};
  const std::vector<MotionNode> nodes = motion_nodes(program, machine_with(CornerRule::ExactStop));
  EXPECT_NEAR(nodes.back().seconds, 2.25, 1e-12);
  const CubicMove cubic{turn.start, turn.finish, turn.speeds->in, turn.speeds->out, turn.seconds};
  for (const MotionNode& node : nodes) {
    if (node.seconds > 2.0 - 1e-9) break;
    EXPECT_NEAR(distance(node.place, cubic.place(node.seconds)), 0.0, 1e-9);
    EXPECT_NEAR(node.speed, length(cubic.speed(node.seconds)), 1e-9);
  }
}

TEST(KinematicPath, HoldsEveryAxisWithinItsOwnLimits) {
  Machine machine;
  machine.x = {.max_speed = 10.0, .max_acceleration = 100.0};
  machine.y = {.max_speed = 4.0, .max_acceleration = 500.0};
  const KinematicPath path = kinematic_path(
      {{{0, 0}, {3, 4}, 1.0, true}, {{3, 4}, {3, -4}, 1.0, true}, {{3, -4}, {-3, -4}, 1.0, true}}, machine);
  EXPECT_DOUBLE_EQ(path.moves[0].max_speed, 5.0);             // 4 / 0.8
  EXPECT_DOUBLE_EQ(path.moves[0].acceleration, 500.0 / 3.0);  // 100 / 0.6
  EXPECT_DOUBLE_EQ(path.moves[1].max_speed, 4.0);
  EXPECT_DOUBLE_EQ(path.moves[2].acceleration, 100.0);
}

}  // namespace
}  // namespace dwell
