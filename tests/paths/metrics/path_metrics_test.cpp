#include "paths/metrics/path_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "paths/lines/raster.h"
#include "tests/paths/domain/path_test_util.h"

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

ToolPath path_of(std::vector<Point> points) {
  ToolPath path;
  path.lifted.assign(points.size(), 0);
  path.points = std::move(points);
  return path;
}

/// A closed polygon of equal sides, turned by an angle: it goes all ways alike.
ToolPath polygon(int sides, double angle) {
  std::vector<Point> points;
  for (int k = 0; k <= sides; ++k) {
    const double phi = angle + 2.0 * std::numbers::pi * k / sides;
    points.push_back({4.0 * std::cos(phi) - 30.0, 4.0 * std::sin(phi) + 7.0});
  }
  return path_of(points);
}

TEST(PathMetrics, ReversalsAreTurnsByMoreThanARightAngleWithinAPiece) {
  // Straight on, square left, back on itself (after a halt), 135 degrees, then a lift that hides a turn.
  ToolPath path = path_of({{0, 0}, {1, 0}, {2, 0}, {2, 3}, {2, 3}, {2, 1}, {4, 3}, {4, 2}, {9, 2}});
  PathMetrics metrics = path_metrics(path);
  EXPECT_EQ(metrics.reversals, 3);  // (2,3): 180; (2,1): 135; (4,3): 135
  EXPECT_NEAR(metrics.sharpest_corner, 180.0, 1e-12);
  path.lifted[5] = 1;  // no tool down on the move to (2,1): the first two of the three are gone
  metrics = path_metrics(path);
  EXPECT_EQ(metrics.reversals, 1);
  EXPECT_NEAR(metrics.sharpest_corner, 135.0, 1e-12);
  EXPECT_EQ(path_metrics(path_of({{0, 0}, {0.1, 0.3}, {0.4, 0.2}})).reversals, 0);  // a right angle, but for rounding
  EXPECT_EQ(path_metrics(polygon(5, 0.1)).reversals, 0);
  EXPECT_NEAR(path_metrics(polygon(5, 0.1)).sharpest_corner, 72.0, 1e-9);
}

TEST(PathMetrics, DirectionsAreWeightedByLengthWithoutTheirSense) {
  const PathMetrics metrics = path_metrics(path_of({{0, 0}, {6, 0}, {5, 0}, {5, -2}, {6, -1}}));
  const double total = 6.0 + 1.0 + 2.0 + std::numbers::sqrt2;
  EXPECT_NEAR(metrics.directions[0], 7.0 / total, 1e-12);
  EXPECT_NEAR(metrics.directions[18], 2.0 / total, 1e-12);
  EXPECT_NEAR(metrics.directions[9], std::numbers::sqrt2 / total, 1e-12);
  EXPECT_NEAR(std::accumulate(metrics.directions.begin(), metrics.directions.end(), 0.0), 1.0, 1e-12);
  // sum L exp(2 i phi) = 7 - 2 + sqrt2 i, sum L exp(4 i phi) = 9 - sqrt2
  EXPECT_NEAR(metrics.anisotropy, std::sqrt(25.0 + 2.0) / total, 1e-12);
  EXPECT_NEAR(metrics.lattice_anisotropy, (9.0 - std::numbers::sqrt2) / total, 1e-12);
}

TEST(PathMetrics, BinsAreCentredOnWholeFiveDegrees) {
  const auto bin_of = [](double degrees) {
    const double phi = degrees * std::numbers::pi / 180.0;
    const PathMetrics metrics = path_metrics(path_of({{1, 1}, {1 + std::cos(phi), 1 + std::sin(phi)}}));
    return std::find(metrics.directions.begin(), metrics.directions.end(), 1.0) - metrics.directions.begin();
  };
  EXPECT_EQ(bin_of(-2.4), 0);
  EXPECT_EQ(bin_of(2.4), 0);
  EXPECT_EQ(bin_of(2.6), 1);
  EXPECT_EQ(bin_of(177.4), 35);
  EXPECT_EQ(bin_of(177.6), 0);
  EXPECT_EQ(bin_of(-90.0), 18);
  EXPECT_EQ(bin_of(-179.0), 0);
  EXPECT_EQ(bin_of(-135.0), 9);
}

TEST(PathMetrics, AnisotropyIsOneForParallelLinesAndNoneForACircle) {
  RasterOptions raster;
  raster.pitch = raster.step.emplace(1.0);
  raster.angle_deg = 30.0;
  raster.serpentine = false;
  const PathMetrics lines = path_metrics(raster_path(test::full_map(14, 40), raster));
  EXPECT_NEAR(lines.anisotropy, 1.0, 1e-12);
  EXPECT_NEAR(lines.directions[6], 1.0, 1e-12);
  const PathMetrics circle = path_metrics(polygon(360, 0.3));
  EXPECT_NEAR(circle.anisotropy, 0.0, 1e-12);
  EXPECT_NEAR(circle.lattice_anisotropy, 0.0, 1e-12);
  const PathMetrics square = path_metrics(polygon(4, 0.3));
  EXPECT_NEAR(square.anisotropy, 0.0, 1e-12);
  EXPECT_NEAR(square.lattice_anisotropy, 1.0, 1e-12);
}

TEST(PathMetrics, WithoutMovesThereAreNoDirections) {
  ToolPath path = path_of({{0, 0}, {0, 0}, {3, 1}});
  path.lifted[2] = 1;
  const PathMetrics metrics = path_metrics(path);
  EXPECT_EQ(metrics.anisotropy, 0.0);
  EXPECT_EQ(metrics.lattice_anisotropy, 0.0);
  EXPECT_EQ(metrics.sharpest_corner, 0.0);
  for (const double share : metrics.directions) EXPECT_EQ(share, 0.0);
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
