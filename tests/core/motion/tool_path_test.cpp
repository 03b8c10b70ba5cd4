#include "core/motion/tool_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

ToolPath path_of(std::vector<Point> points) {
  ToolPath path;
  path.lifted.assign(points.size(), 0);
  path.points = std::move(points);
  return path;
}

/// The midpoints of a chain of nodes.
ToolPath midpoints_of(const std::vector<Point>& nodes) {
  std::vector<Point> points;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) points.push_back(midpoint(nodes[k], nodes[k + 1]));
  return path_of(points);
}

void expect_near(Point actual, Point expected, double tolerance = 1e-12) {
  EXPECT_LE(distance(actual, expected), tolerance)
      << "(" << actual.x << ", " << actual.y << ") for (" << expected.x << ", " << expected.y << ")";
}

void expect_nodes(const std::vector<Stroke>& strokes, const std::vector<Point>& nodes, double tolerance = 1e-12) {
  ASSERT_EQ(strokes.size() + 1, nodes.size());
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    SCOPED_TRACE(j);
    expect_near(strokes[j].start, nodes[j], tolerance);
    expect_near(strokes[j].finish, nodes[j + 1], tolerance);
  }
}

/// Two lines of `count` unit steps joined by one unit step up, as a planner that thinks in segments writes them.
std::vector<Point> chain_with_turn(int count) {
  std::vector<Point> nodes;
  for (int k = 0; k <= count; ++k) nodes.push_back({static_cast<double>(k), 0.0});
  for (int k = count; k >= 0; --k) nodes.push_back({static_cast<double>(k), 1.0});
  return nodes;
}

TEST(MovingStrokes, MeetHalfwayBetweenNeighbours) {
  const ToolPath path = path_of({{0, 0}, {1, 0}, {4, 0}, {4, 2}});
  const auto strokes = moving_strokes(path);
  // The ends go straight on: (0,0) - ((0.5,0) - (0,0)), and (4,2) + ((4,2) - (4,1)).
  expect_nodes(strokes, {{-0.5, 0}, {0.5, 0}, {2.5, 0}, {4, 1}, {4, 3}});
  for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(strokes[j].via, path.points[j]);
  EXPECT_DOUBLE_EQ(strokes[2].length(), 1.5 + 1.0);
}

TEST(MovingStrokes, AreCutAtLifts) {
  ToolPath path = path_of({{0, 0}, {1, 0}, {4, 0}, {10, 0}, {10, 4}});
  path.lifted = {1, 0, 0, 1, 0};
  const auto strokes = moving_strokes(path);
  ASSERT_EQ(strokes.size(), 5u);
  expect_near(strokes[2].start, {2.5, 0});
  expect_near(strokes[2].finish, {5.5, 0});
  expect_near(strokes[3].start, {10, -2});
  expect_near(strokes[3].finish, {10, 2});
  expect_near(strokes[4].finish, {10, 6});
}

TEST(MovingStrokes, HaltWhereAPointIsAlone) {
  ToolPath path = path_of({{0, 0}, {5, 5}, {7, 5}, {9, 9}});
  path.lifted = {0, 1, 0, 1};
  const auto strokes = moving_strokes(path);
  for (std::size_t j : {0u, 3u}) {
    EXPECT_EQ(strokes[j].start, path.points[j]);
    EXPECT_EQ(strokes[j].via, path.points[j]);
    EXPECT_EQ(strokes[j].finish, path.points[j]);
    EXPECT_EQ(strokes[j].length(), 0.0);
  }
  EXPECT_DOUBLE_EQ(strokes[1].length(), 2.0);
  ASSERT_EQ(moving_strokes(path_of({{1, 2}})).size(), 1u);
  EXPECT_TRUE(moving_strokes(ToolPath{}).empty());
}

TEST(MovingStrokes, OnAStraightLineOfEqualStepsAreTheStepsThemselves) {
  std::vector<Point> nodes;
  for (int k = 0; k <= 50; ++k) nodes.push_back({0.6 * k - 3.0, 0.8 * k + 1.0});
  const auto strokes = moving_strokes(midpoints_of(nodes));
  expect_nodes(strokes, nodes);
}

TEST(MovingStrokes, TurnWhereAChainOfEqualStepsTurns) {
  const auto nodes = chain_with_turn(20);
  const auto strokes = moving_strokes(midpoints_of(nodes));
  expect_nodes(strokes, nodes);
  for (const Stroke& s : strokes) EXPECT_NEAR(s.length(), 1.0, 1e-12);
}

TEST(MovingStrokes, TakeALastStepCutShort) {
  auto nodes = chain_with_turn(20);
  nodes.back() = nodes[nodes.size() - 2] + 0.37 * (nodes.back() - nodes[nodes.size() - 2]);
  const auto strokes = moving_strokes(midpoints_of(nodes));
  expect_nodes(strokes, nodes);
  EXPECT_NEAR(strokes.back().length(), 0.37, 1e-12);
}

TEST(MovingStrokes, KnowAChainInEachPieceByItself) {
  const auto nodes = chain_with_turn(6);
  const ToolPath chain = midpoints_of(nodes);
  ToolPath path = chain;
  for (Point p : {Point{0, 9}, Point{1, 9}, Point{5, 9}}) path.points.push_back(p);
  path.lifted.assign(path.points.size(), 0);
  path.lifted[chain.size()] = 1;
  auto strokes = moving_strokes(path);
  expect_near(strokes.back().finish, {7, 9});
  expect_near(strokes.back().start, {3, 9});
  strokes.resize(chain.size());
  expect_nodes(strokes, nodes);
}

// A raster given as dwell points on the lines themselves: the step between lines joins two corner points, whose
// halfway node lies beside both lines, and no chain of equal steps has these points as midpoints.
TEST(MovingStrokes, TakeASerpentineOfDwellPointsByHalves) {
  std::vector<Point> points;
  for (int k = 0; k < 6; ++k) points.push_back({static_cast<double>(k), 0.0});
  for (int k = 5; k >= 0; --k) points.push_back({static_cast<double>(k), 1.0});
  const auto strokes = moving_strokes(path_of(points));
  expect_near(strokes[5].start, {4.5, 0.0});
  expect_near(strokes[5].finish, {5.0, 0.5});
  expect_near(strokes[6].start, {5.0, 0.5});
  expect_near(strokes[6].finish, {4.5, 1.0});
  EXPECT_NEAR(strokes[5].length(), 1.0, 1e-12);
}

// Repeated points are the midpoints of a chain that runs to and fro, but nobody means that one.
TEST(MovingStrokes, TakeNoChainThatTurnsBack) {
  ToolPath path;
  path.points = {{0, 0}, {1, 0}, {1, 0}, {1, 0}, {2, 0}};
  path.lifted = {1, 0, 0, 0, 0};
  const auto strokes = moving_strokes(path);
  EXPECT_EQ(strokes[1].length(), 0.5);
  EXPECT_EQ(strokes[2].length(), 0.0);
}

TEST(MovingStrokes, TakeAChainToATolerance) {
  const auto nodes = chain_with_turn(20);
  const auto is_chain = [](const ToolPath& path) {
    // By halves, the stroke before the turn would end 0.25 short of the corner on either axis.
    return distance(moving_strokes(path)[19].finish, {20.0, 0.0}) < 0.1;
  };
  ASSERT_TRUE(is_chain(midpoints_of(nodes)));
  for (std::size_t j : {0u, 7u, 19u, 20u, 30u, 40u}) {
    SCOPED_TRACE(j);
    ToolPath path = midpoints_of(nodes);
    path.points[j].x += 0.1 * kEqualSteps;  // the odd reflections double it
    EXPECT_TRUE(is_chain(path));
    path = midpoints_of(nodes);
    path.points[j].x += 5.0 * kEqualSteps;
    EXPECT_EQ(is_chain(path), j == 40u);  // moved towards its node, the last point ends a step cut short
  }
}

TEST(MovingStrokes, DoNotLetALastStepRunLong) {
  auto nodes = chain_with_turn(20);
  nodes.back() = nodes[nodes.size() - 2] + 1.01 * (nodes.back() - nodes[nodes.size() - 2]);
  const auto strokes = moving_strokes(midpoints_of(nodes));
  expect_near(strokes[19].finish, midpoint({19.5, 0.0}, {20.0, 0.5}));
}

// Printed to micrometres, a chain of thousands of steps must neither be refused nor drift.
TEST(MovingStrokes, KeepALongRoundedChainInPlace) {
  std::vector<Point> nodes = {{0.0, 0.0}};
  for (int line = 0; line < 20; ++line) {
    for (int k = 0; k < 100; ++k) nodes.push_back(nodes.back() + Point{line % 2 ? -0.7 : 0.7, 0.0});
    for (int k = 0; k < 2; ++k) nodes.push_back(nodes.back() + Point{0.0, 0.7});
  }
  ToolPath path = midpoints_of(nodes);
  for (Point& p : path.points) p = {std::round(p.x * 1e6) / 1e6, std::round(p.y * 1e6) / 1e6};
  expect_nodes(moving_strokes(path), nodes, 1e-5);
}

TEST(MovingStrokes, TakeRepeatedPoints) {
  const auto strokes = moving_strokes(path_of({{1, 1}, {1, 1}, {1, 1}, {3, 1}}));
  EXPECT_EQ(strokes[0].length(), 0.0);
  EXPECT_EQ(strokes[1].length(), 0.0);
  expect_near(strokes[2].finish, {2, 1});
  expect_near(strokes[3].finish, {4, 1});
}

TEST(HaltingStrokes, StandAtTheirPoints) {
  const ToolPath path = path_of({{0, 0}, {1, 2}, {3, 4}});
  const auto strokes = halting_strokes(path);
  ASSERT_EQ(strokes.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(strokes[j].start, path.points[j]);
    EXPECT_EQ(strokes[j].via, path.points[j]);
    EXPECT_EQ(strokes[j].finish, path.points[j]);
  }
}

TEST(ToolPath, IsRefusedByPointAndSize) {
  EXPECT_NO_THROW(validate(path_of({{0, 0}})));
  expect_input_error([] { validate(ToolPath{}); }, {"no dwell points"});
  ToolPath path = path_of({{0, 0}, {1, 0}, {2, 0}});
  path.lifted.pop_back();
  expect_input_error([&] { validate(path); }, {"3 points", "2 lift flags"});
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    path = path_of({{0, 0}, {1, 0}, {2, 0}});
    path.points[1].y = bad;
    expect_input_error([&] { validate(path); }, {"point 2", "finite"});
    path.points[1] = {bad, 0.0};
    expect_input_error([&] { validate(path); }, {"point 2", "finite"});
  }
}

}  // namespace
}  // namespace dwell
