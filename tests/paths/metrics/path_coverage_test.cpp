#include "paths/metrics/path_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "paths/lines/raster.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::kInf;
using test::kNaN;
using test::message_of;

double to_segment(Point p, Point a, Point b) {
  const double l2 = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  double t = l2 > 0.0 ? ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / l2 : 0.0;
  t = std::min(1.0, std::max(0.0, t));
  return std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y));
}

/// Every pixel against every stroke.
Index oracle(const ToolPath& path, const HeightMap& map, double reach) {
  const std::vector<Stroke> strokes = moving_strokes(path);
  Index covered = 0;
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      const Point p = map.grid.centre(row, col);
      double nearest = kInf;
      for (const Stroke& s : strokes) {
        nearest = std::min({nearest, to_segment(p, s.start, s.via), to_segment(p, s.via, s.finish)});
      }
      covered += nearest <= reach * (1.0 + 1e-9) + 1e-10;
    }
  }
  return covered;
}

HeightMap map_with_holes(std::mt19937& random) {
  HeightMap map = test::full_map(23, 31, 0.4, 0.7, {-5.0, 80.0});
  for (double& v : map.values) {
    if (random() % 5 == 0) v = kNaN;
  }
  return map;
}

TEST(PathCoverage, AgreesWithEveryPixelAgainstEveryStroke) {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> x(-8.0, 10.0), y(76.0, 99.0), reach(0.0, 2.5);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const HeightMap map = map_with_holes(random);
    ToolPath path;
    for (int k = 0; k < 7; ++k) {
      path.points.push_back({x(random), y(random)});
      if (k % 3 == 1) path.points.back().x = path.points.front().x;  // upright
      if (k % 4 == 2) path.points.back().y = path.points.front().y;  // level
      path.lifted.push_back(random() % 3 == 0);
    }
    const double r = reach(random);
    const PathCoverage coverage = path_coverage(path, map, r);
    EXPECT_EQ(coverage.pixels, map.valid_pixels());
    EXPECT_EQ(coverage.covered, oracle(path, map, r));
  }
}

TEST(PathCoverage, OfARasterIsCompleteAtHalfItsPitchAndNotBelow) {
  RasterOptions options;
  options.pitch = 2.0;
  options.step = 0.5;
  const HeightMap map = test::full_map(21, 9, 1.0, 1.0, {3.0, 7.0});
  const ToolPath path = raster_path(map, options);  // lines at every other row: the rows between are 1 mm away
  EXPECT_EQ(path_coverage(path, map, 1.0).share(), 1.0);
  EXPECT_LT(path_coverage(path, map, 0.99).share(), 0.6);
}

TEST(PathCoverage, CountsAHaltAndNothingUnderALiftedMove) {
  const HeightMap map = test::full_map(5, 11);
  ToolPath path;
  path.points = {{1, 2}, {9, 2}};
  path.lifted = {1, 1};
  EXPECT_EQ(path_coverage(path, map, 0.0).covered, 2);
  EXPECT_EQ(path_coverage(path, map, 1.0).covered, 10);
  EXPECT_EQ(path_coverage(path, map, 1e6).covered, 55);
  path.points = {{1e7, 2}, {-1e7, 3000}};
  EXPECT_EQ(path_coverage(path, map, 1.0).covered, 0);
}

TEST(PathCoverage, RefusesBadInput) {
  ToolPath path;
  path.points = {{1, 2}};
  path.lifted = {1};
  const HeightMap map = test::full_map(3, 4);
  for (const double reach : {-1.0, kNaN, kInf}) {
    EXPECT_NE(message_of([&] { path_coverage(path, map, reach); }).find("required finite and >= 0"), std::string::npos);
  }
  EXPECT_EQ(message_of([&] { path_coverage(path, HeightMap(map.grid), 1.0); }),
            "path coverage: the map has no finite pixel; at least one is required");
  path.points[0].x = kNaN;
  EXPECT_NE(message_of([&] { path_coverage(path, map, 1.0); }).find("point 1"), std::string::npos);
}

}  // namespace
}  // namespace dwell
