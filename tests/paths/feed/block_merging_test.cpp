#include "paths/feed/block_merging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/segment.h"
#include "paths/feed/block_check.h"
#include "paths/feed/constant_schedule.h"
#include "paths/feed/execution.h"
#include "paths/feed/least_dwell.h"

namespace dwell {
namespace {

/// A raster of three lines with their turns, then after a lift one crooked stretch, and one of a few points. Steps of
/// `step` along the lines.
ToolPath lines(double step) {
  ToolPath path{"file", {}, {}};
  for (int line = 0; line < 3; ++line) {
    const int steps = static_cast<int>(20.0 / step);
    for (int k = 0; k <= steps; ++k) path.points.push_back({line % 2 == 0 ? step * k : step * (steps - k), 1.3 * line});
  }
  const std::size_t lifted = path.points.size();
  for (int k = 0; k < 30; ++k) path.points.push_back({30.0 + 0.2 * k, 3.0 + 0.1 * k + (k % 7 == 0 ? 0.15 : 0.0)});
  const std::size_t last = path.points.size();
  for (int k = 0; k < 3; ++k) path.points.push_back({40.0 + 3.0 * k, -2.0});
  path.lifted.assign(path.points.size(), 0);
  path.lifted[0] = path.lifted[lifted] = path.lifted[last] = 1;
  return path;
}

/// Midpoints of a chain of equal steps that turns between its points.
ToolPath chain() {
  std::vector<Point> nodes{{0, 0}};
  const auto go = [&nodes](Point step, int times) {
    for (int k = 0; k < times; ++k) nodes.push_back(nodes.back() + step);
  };
  for (int line = 0; line < 3; ++line) {
    go({line % 2 == 0 ? 0.5 : -0.5, 0.0}, 37);
    if (line < 2) go({0.0, 0.5}, 3);
  }
  ToolPath path{"file", {}, {}};
  for (std::size_t k = 1; k < nodes.size(); ++k) path.points.push_back(midpoint(nodes[k - 1], nodes[k]));
  path.lifted.assign(path.points.size(), 0);
  path.lifted[0] = 1;
  return path;
}

Eigen::VectorXd uneven_seconds(const ToolPath& path) {
  const std::vector<Stroke> strokes = moving_strokes(path);
  Eigen::VectorXd seconds(static_cast<Index>(strokes.size()));
  for (Index j = 0; j < seconds.size(); ++j) {
    const double speed = 12.0 + 9.0 * std::sin(0.21 * static_cast<double>(j));  // [mm/s]
    seconds[j] = strokes[static_cast<std::size_t>(j)].length() / speed;
  }
  return seconds;
}

/// The moves at work.
std::vector<ProgramStep> work_of(const ToolPath& path) {
  std::vector<ProgramStep> work;
  for (const ProgramStep& step : stroke_moves(path, Motion::Moving).steps) {
    if (step.removes) work.push_back(step);
  }
  return work;
}

/// How far a point lies from the nearest of some moves.
double way_to(Point p, const std::vector<ProgramStep>& moves) {
  double least = std::numeric_limits<double>::infinity();
  for (const ProgramStep& move : moves) least = std::min(least, distance_to_segment(p, move.start, move.finish));
  return least;
}

/// The time that the strokes of a path spend between two places of its work, by way [mm] from its beginning.
double time_between(const ToolPath& path, const Eigen::VectorXd& seconds, double from, double to) {
  const StrokeMoves moves = stroke_moves(path, Motion::Moving);
  double way = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (!moves.steps[i].removes) continue;
    const double length = moves.steps[i].length();
    const double inside = std::min(to, way + length) - std::max(from, way);
    if (inside > 0.0) sum += seconds[moves.stroke[i]] * moves.share[i] * inside / length;
    way += length;
  }
  return sum;
}

TEST(BlockMerging, KeepsTheWayOfTheTool) {
  EXPECT_EQ(moving_strokes(chain())[37].start, (Point{18.5, 0.0}));  // it turns between its points
  for (const ToolPath& path : {lines(0.5), lines(0.8), chain()}) {
    const MergedPath merged = merge_short_blocks(path, uneven_seconds(path), 0.15);
    EXPECT_GT(merged.short_before, 20U);
    EXPECT_LT(merged.blocks_after, merged.blocks_before);
    const std::vector<ProgramStep> before = work_of(path), after = work_of(merged.path);
    double length_before = 0.0, length_after = 0.0;
    for (const ProgramStep& move : before) {
      length_before += move.length();
      EXPECT_LE(way_to(move.finish, after), 1e-5);
      EXPECT_LE(way_to(move.start, after), 1e-5);
    }
    for (const ProgramStep& move : after) {
      length_after += move.length();
      EXPECT_LE(way_to(move.start, before), 1e-5);
      EXPECT_LE(way_to(midpoint(move.start, move.finish), before), 1e-5);
    }
    EXPECT_NEAR(length_after, length_before, 1e-4);
    EXPECT_EQ(merged.blocks_before, before.size());
    EXPECT_EQ(merged.blocks_after, after.size());
  }
}

TEST(BlockMerging, GivesBlocksTheirTimeWhereTheyAreStraightOn) {
  constexpr double kLeast = 0.1;
  const ToolPath path = lines(0.5);
  const Eigen::VectorXd seconds = uneven_seconds(path);
  const MergedPath merged = merge_short_blocks(path, seconds, 1.1 * kLeast);
  double way = 0.0;
  std::size_t too_short = 0;
  for (const ProgramStep& move : work_of(merged.path)) {
    const double taken = time_between(path, seconds, way, way + move.length());
    way += move.length();
    const bool on_lines = move.start.x < 25.0 && std::abs(move.start.y - move.finish.y) < 1e-6;
    if (on_lines) {
      // Beside a corner a block is half of a way, of which the tool may run one half faster.
      EXPECT_GE(taken, 0.85 * kLeast) << move.start.x << ", " << move.start.y;
    }
    too_short += static_cast<std::size_t>(taken < kLeast);
  }
  EXPECT_LT(too_short, merged.short_before / 3);  // what is left stands at corners closer than two blocks
}

TEST(BlockMerging, LeavesStretchesOfLongBlocksAsTheyAre) {
  const ToolPath path = lines(0.5);
  const MergedPath none = merge_short_blocks(path, uneven_seconds(path), 1e-4);
  EXPECT_EQ(none.short_before, 0U);
  EXPECT_EQ(none.path.points, path.points);
  // The last stretch, of three points 3 mm apart, keeps them while others are merged.
  const MergedPath merged = merge_short_blocks(path, uneven_seconds(path), 0.05);
  ASSERT_GT(merged.short_before, 0U);
  EXPECT_TRUE(std::equal(path.points.end() - 3, path.points.end(), merged.path.points.end() - 3));
  EXPECT_EQ(merged.path.lifted[merged.path.size() - 3], 1);
}

TEST(BlockCheck, CountsStepsAtWorkByTheTimeOfTheMachine) {
  Machine machine;
  machine.path_acceleration = 10.0;
  machine.controller.max_blocks_per_s = 20.0;
  Program program{"",
                  {{{0, 0}, {1, 0}, 0.049, true},  // takes 0.63 s from rest to rest
                   {{1, 0}, {1, 0}, 0.04, true},
                   {{1, 0}, {1.01, 0}, 0.01, false},
                   {{1.01, 0}, {1.01, 0}, 0.045, true}}};
  const auto fault = short_blocks(program, machine);
  ASSERT_TRUE(fault);
  EXPECT_EQ(
      *fault,
      "2 steps of the program are shorter than the 50 ms that the controller takes for a block (20 blocks/s): the "
      "first is step 2, of 40 ms");
  machine.controller.max_blocks_per_s = 25.0;
  EXPECT_FALSE(short_blocks(program, machine));
  EXPECT_FALSE(short_blocks(program, Machine{}));
}

TEST(BlockCheck, FeedsOfAScheduleKeepTheRate) {
  Machine machine;
  machine.path_acceleration = 200.0;
  machine.max_feed = 30.0;
  machine.controller.max_blocks_per_s = 8.0;
  const StrokeMoves moves = stroke_moves(lines(0.5), Motion::Moving);
  const KinematicPath path = kinematic_path(moves.steps, machine);
  const ConstantSchedule schedule = schedule_constant(moves, path, machine, least_dwell(moves, path, machine));
  Program program{"", moves.steps};
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves.stroke[i] != StrokeMoves::kNoStroke)
      program.steps[i].seconds = moves.steps[i].length() / schedule.feed[static_cast<std::size_t>(moves.stroke[i])];
  }
  EXPECT_FALSE(short_blocks(program, machine));
  machine.controller.max_blocks_per_s = 10.0;
  EXPECT_FALSE(short_blocks(program, machine));
  for (ProgramStep& step : program.steps) step.seconds *= 0.5;
  EXPECT_TRUE(short_blocks(program, machine));
}

}  // namespace
}  // namespace dwell
