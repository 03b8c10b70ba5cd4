#include "paths/path_metrics.h"

#include <gtest/gtest.h>

#include "tests/paths/path_test_util.h"

namespace dwell {
namespace {

TEST(PathMetrics, CountsStrokesMovesAndLifts) {
  // Two runs: (0,0) (3,4) (6,8), lifted 10 mm to (16,8), on to (16,10); then lifted 5 mm to a point alone at (19,14).
  ToolPath path;
  path.points = {{0, 0}, {3, 4}, {6, 8}, {16, 8}, {16, 10}, {19, 14}};
  path.lifted = {1, 0, 0, 1, 0, 1};
  const PathMetrics metrics = path_metrics(path);
  EXPECT_EQ(metrics.points, 6);
  EXPECT_DOUBLE_EQ(metrics.length, 3 * 5.0 + 2 * 2.0);  // n strokes of one step each; the halt adds nothing
  EXPECT_DOUBLE_EQ(metrics.point_length, 5 + 5 + 10 + 2 + 5);
  EXPECT_DOUBLE_EQ(metrics.lifted_length, 15.0);
  EXPECT_DOUBLE_EQ(metrics.longest_jump, 10.0);
  EXPECT_EQ(metrics.lifts, 2);
}

TEST(PathMetrics, AStrokeTurnsAtItsDwellPoint) {
  ToolPath path;
  path.points = {{0, 0}, {2, 0}, {2, 4}};
  path.lifted = {0, 0, 0};  // the first counts as lifted either way
  const PathMetrics metrics = path_metrics(path);
  EXPECT_DOUBLE_EQ(metrics.length, 2.0 + (1.0 + 2.0) + 4.0);
  EXPECT_DOUBLE_EQ(metrics.longest_jump, 4.0);
  EXPECT_EQ(metrics.lifts, 0);
}

TEST(PathMetrics, RefusesAnInvalidPath) {
  EXPECT_NE(test::message_of([] { path_metrics(ToolPath{}); }).find("no dwell points"), std::string::npos);
  ToolPath path;
  path.points = {{0, 0}, {1, test::kNaN}};
  path.lifted = {1, 0};
  EXPECT_NE(test::message_of([&] { path_metrics(path); }).find("point 2"), std::string::npos);
}

}  // namespace
}  // namespace dwell
