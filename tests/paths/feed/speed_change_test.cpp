#include "paths/feed/speed_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "paths/feed/execution.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/trapezoid.h"
#include "tests/paths/feed/motion_oracle.h"

namespace dwell {
namespace {

struct SteppedChange {
  double seconds, length;
};

/// By small steps of time: the acceleration rises as long as what would go by while it falls again is not yet too much.
SteppedChange step_change(double from, double to, double acceleration, double jerk, double step) {
  double v = from, a = 0.0, t = 0.0, s = 0.0;
  while (v < to && t < 100.0) {
    const bool falls = v + a * a / (2.0 * jerk) >= to;
    a = falls ? std::max(0.0, a - jerk * step) : std::min(acceleration, a + jerk * step);
    if (falls && a <= 0.0) break;
    v += a * step, s += v * step, t += step;
  }
  return {t, s};
}

TEST(SpeedChange, TakesTimeAndWayOfAMotionByStepsOfTime) {
  for (const double to : {2.5, 4.0, 12.0}) {
    const SpeedChange change{20.0, 150.0};
    const SteppedChange slow = step_change(1.5, to, 20.0, 150.0, 1e-6);
    EXPECT_NEAR(change.seconds(to - 1.5), slow.seconds, 1e-3) << to;
    EXPECT_NEAR(change.length(1.5, to), slow.length, 5e-3) << to;
    EXPECT_DOUBLE_EQ(change.seconds(1.5 - to), change.seconds(to - 1.5));
  }
  EXPECT_DOUBLE_EQ((SpeedChange{20.0}.seconds(5.0)), 0.25);
  EXPECT_DOUBLE_EQ((SpeedChange{INFINITY, 8.0}.seconds(2.0)), 1.0);
  EXPECT_DOUBLE_EQ((SpeedChange{20.0, 150.0}.peak(0.5)), std::sqrt(75.0));
  EXPECT_DOUBLE_EQ((SpeedChange{20.0, 150.0}.peak(50.0)), 20.0);
}

TEST(SpeedChange, ReachesTheSpeedThatTakesTheWay) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 400; ++k) {
    const SpeedChange change{std::pow(10.0, 3.0 * unit(random)), std::pow(10.0, 5.0 * unit(random))};
    const double from = k % 5 == 0 ? 0.0 : 20.0 * unit(random), length = std::pow(10.0, -4.0 + 5.0 * unit(random));
    const double to = change.reached(from, length);
    EXPECT_LE(change.length(from, std::max(from, to * (1.0 - 1e-13))), length * (1.0 + 1e-9)) << k;
    EXPECT_GE(change.length(from, to * (1.0 + 1e-13)), length * (1.0 - 1e-9)) << k;
  }
  EXPECT_DOUBLE_EQ((SpeedChange{8.0}.reached(3.0, 1.0)), 5.0);
}

Trapezoid bent(double length, double in, double out) { return {length, 30.0, in, out, INFINITY, 400.0}; }

TEST(SpeedChange, MakesMovesOfPiecesThatAddUp) {
  for (const double feed : {1.2, 2.0, 3.5, 6.0, 90.0}) {
    for (const Trapezoid& m : {bent(1.7, 0.5, 1.2), bent(0.4, 0.0, 0.0), bent(2.0, 3.0, 0.0)}) {
      double length = 0.0, seconds = 0.0, speed = m.speed_in, acceleration = 0.0;
      for (const MotionPiece& piece : pieces_at_feed(m, feed)) {
        EXPECT_EQ(piece.speed_in, speed);
        EXPECT_NEAR(piece.acceleration_in(), acceleration, 1e-6);  // it does not jump
        const double all = piece.seconds();
        EXPECT_NEAR(piece.way(all), piece.length, 1e-9);
        EXPECT_NEAR(piece.speed(all), piece.speed_out, 1e-9);
        EXPECT_LE(std::abs(piece.jerk), 400.0);
        acceleration = piece.acceleration_in() + piece.jerk * all;
        EXPECT_LE(std::abs(acceleration), 30.0 + 1e-6);
        length += piece.length, seconds += all, speed = piece.speed_out;
      }
      EXPECT_NEAR(length, m.length, 1e-12);
      EXPECT_NEAR(seconds, time_at_feed(m, feed), 1e-9);
      EXPECT_EQ(speed, m.speed_out);
      EXPECT_NEAR(acceleration, 0.0, 1e-6);
      EXPECT_GT(seconds, time_at_feed({m.length, m.acceleration, m.speed_in, m.speed_out}, feed));
    }
  }
}

TEST(SpeedChange, IsThatOfNoJerkWhereJerkIsLarge) {
  for (const double feed : {2.0, 3.5, 90.0}) {
    const Trapezoid free{1.7, 30.0, 0.5, 1.2}, large{1.7, 30.0, 0.5, 1.2, INFINITY, 1e12};
    EXPECT_NEAR(time_at_feed(large, feed), time_at_feed(free, feed), 1e-9);
    EXPECT_NEAR(peak_speed(large), peak_speed(free), 1e-9);
  }
}

TEST(SpeedChange, FindsTheFeedThatTakesATime) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int held = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<Trapezoid> moves;
    double corner = 0.5 * unit(random), fastest = 0.0;
    for (int i = 0; i < 1 + k % 3; ++i) {
      const double length = 0.2 + unit(random), most = bent(length, corner, 0.0).change().reached(corner, length);
      const double next = std::min(0.8 * unit(random), most);
      moves.push_back(bent(length, corner, next));
      if (moves.back().change().length(next, corner) > length) moves.back().speed_in = next;
      fastest += time_at_feed(moves.back(), 100.0);
      corner = next;
    }
    const double seconds = fastest * (1.0 + 0.5 * unit(random)), feed = feed_for_time(moves, seconds, 100.0);
    double taken = 0.0, fastest_end = 0.0;
    for (const Trapezoid& m : moves) {
      taken += time_at_feed(m, feed);
      fastest_end = std::max({fastest_end, m.speed_in, m.speed_out});
    }
    if (feed < fastest_end) continue;
    EXPECT_NEAR(taken, seconds, 1e-9 * seconds) << k;
    ++held;
  }
  EXPECT_GT(held, 100);
  EXPECT_EQ(feed_for_time({bent(1.0, 0.0, 0.0)}, 1e-3, 40.0), 40.0);  // cannot
}

/// The highest speeds at the nodes, by trying: none may be out of reach of a neighbour, none could be higher.
TEST(SpeedChange, LooksAheadOverNodes) {
  Machine machine;
  machine.path_acceleration = 12.0, machine.path_jerk = 90.0;
  machine.corner = CornerRule::JunctionDeviation;
  machine.junction_deviation = 0.5;
  const std::vector<ProgramStep> steps = test::crooked_chain(7, 60, 1.0, 8.0);
  const KinematicPath path = kinematic_path(steps, machine);
  std::vector<double> feed;
  for (const ProgramStep& step : steps) feed.push_back(step.length() / step.seconds);
  const std::vector<double> u = node_speeds_squared(path, feed);
  const auto can = [&](std::size_t move, double a, double b) {
    return path.moves[move].change().length(a, b) <= path.moves[move].length * (1.0 + 1e-9);
  };
  int bound = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double v = std::sqrt(u[i]), before = std::sqrt(u[i - 1]), after = std::sqrt(u[i + 1]), more = v + 1e-6;
    EXPECT_TRUE(can(i - 1, before, v)) << i;
    EXPECT_TRUE(can(i, v, after)) << i;
    const bool capped = more > feed[i - 1] || more > feed[i] || more * more > path.corner[i];
    if (capped) continue;
    EXPECT_FALSE(can(i - 1, before, more) && can(i, more, after)) << i;
    ++bound;
  }
  EXPECT_GT(bound, 5);
}

/// Removal goes by where the tool is when: the motion is held to steps of time through every move.
TEST(SpeedChange, ExecutesMovesByS) {
  Machine machine;
  machine.path_acceleration = 40.0, machine.path_jerk = 900.0;
  Program program;
  program.steps = {{{-1.0, 0.5}, {1.0, 2.0}, 0.5, true}, {{1.0, 2.0}, {1.6, 1.2}, 0.4, true}};
  const Execution run = execute(program, machine);
  EXPECT_LE(run.max_acceleration, 40.0 * (1.0 + 1e-12));
  EXPECT_GT(run.max_acceleration, 30.0);
  const SpeedChange change{40.0, 900.0};
  for (const std::size_t i : {0U, 1U}) {
    const double length = program.steps[i].length(), feed = length / program.steps[i].seconds;
    const double v = std::min(feed, peak_speed({length, 40.0, 0.0, 0.0, INFINITY, 900.0}));
    EXPECT_NEAR(run.seconds[i], 2.0 * change.seconds(v) + (length - 2.0 * change.length(0.0, v)) / v, 1e-9);
  }
  // Along the first move, where the tool is after t by small steps of the jerk.
  double t = 0.0, a = 0.0, v = 0.0, s = 0.0, end = 0.0;
  const double half = change.seconds(program.steps[0].length() / 0.5), up = 40.0 / 900.0, step = 1e-6;
  std::size_t k = 0;
  for (; t < half; t += step) {
    const double jerk = t < up ? 900.0 : t < half - up ? 0.0 : -900.0;
    a += jerk * step, v += a * step, s += v * step;
    while (end + run.motion.steps[k].seconds <= t) {
      end += run.motion.steps[k].seconds;
      EXPECT_NEAR(distance(run.motion.steps[k].finish, program.steps[0].start), s, 2e-4) << k;
      ++k;
    }
  }
  EXPECT_GT(k, 10U);
}

TEST(SpeedChange, TablesOfMotionAreOfConstantAccelerationBetweenRows) {
  Machine machine;
  machine.path_acceleration = 100.0, machine.path_jerk = 800.0;
  Program program;
  program.steps = {{{0.0, 0.0}, {8.0, 6.0}, 0.7, true}, {{8.0, 6.0}, {9.0, 1.0}, 1.3, true}};
  const std::vector<MotionNode> nodes = motion_nodes(program, machine);
  double farthest = 0.0;
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    const double way = 0.5 * (nodes[k].speed + nodes[k - 1].speed) * (nodes[k].seconds - nodes[k - 1].seconds);
    farthest = std::max(farthest, std::abs(way - distance(nodes[k].place, nodes[k - 1].place)));
  }
  EXPECT_LE(farthest, 1e-4);
  EXPECT_GT(farthest, 1e-6);  // it is no constant acceleration
}

}  // namespace
}  // namespace dwell
