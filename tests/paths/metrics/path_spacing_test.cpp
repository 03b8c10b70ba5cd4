#include "paths/metrics/path_spacing.h"

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

/// All pairs, straight from the definition.
PathSpacing oracle(const ToolPath& path, long skip, double detour) {
  std::vector<double> nearest;
  PathSpacing result;
  const long n = static_cast<long>(path.points.size());
  for (long i = 0; i < n; ++i) {
    double best = kInf;
    for (long j = 0; j < n; ++j) {
      if (j >= i - skip && j <= i + skip) continue;
      const Point a = path.points.at(static_cast<std::size_t>(i)), b = path.points.at(static_cast<std::size_t>(j));
      const double apart = std::hypot(a.x - b.x, a.y - b.y);
      double run = 0.0;
      bool lift = false;
      for (long k = std::min(i, j) + 1; k <= std::max(i, j); ++k) {
        const Point c = path.points[static_cast<std::size_t>(k - 1)], d = path.points[static_cast<std::size_t>(k)];
        run += std::hypot(c.x - d.x, c.y - d.y);
        lift = lift || path.lifted[static_cast<std::size_t>(k)];
      }
      if (lift || run >= detour * apart - 1e-9 * (apart + 1.0)) best = std::min(best, apart);
    }
    if (best < kInf) nearest.push_back(best);
  }
  result.points = static_cast<Index>(nearest.size());
  result.alone = n - result.points;
  if (nearest.empty()) return result;
  result.min = *std::min_element(nearest.begin(), nearest.end());
  result.max = *std::max_element(nearest.begin(), nearest.end());
  for (const double d : nearest) result.mean += d / static_cast<double>(nearest.size());
  for (const double d : nearest) {
    result.deviation += (d - result.mean) * (d - result.mean) / static_cast<double>(nearest.size());
  }
  result.deviation = std::sqrt(result.deviation);
  return result;
}

TEST(PathSpacing, AgreesWithAllPairsOnRandomPaths) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> turn(-0.6, 0.6), even(0.0, 1.0);
  for (int repeat = 0; repeat < 6; ++repeat) {
    ToolPath path;
    Point p{3.0, -20.0};
    double heading = 0.0;
    for (int k = 0; k < 180; ++k) {
      path.points.push_back(p);
      path.lifted.push_back(even(random) < 0.03 ? 1 : 0);
      heading += turn(random);
      p = p + Point{0.5 * std::cos(heading), 0.5 * std::sin(heading)};
      if (k == 90) path.points.back() = path.points[40];  // one place twice
    }
    for (const Index skip : {1, 3}) {
      for (const double detour : {1.3, 2.0, 5.0}) {
        const PathSpacing got = path_spacing(path, {skip, detour});
        const PathSpacing expected = oracle(path, skip, detour);
        EXPECT_EQ(got.points, expected.points);
        EXPECT_EQ(got.alone, expected.alone);
        EXPECT_NEAR(got.min, expected.min, 1e-12);
        EXPECT_NEAR(got.mean, expected.mean, 1e-12);
        EXPECT_NEAR(got.deviation, expected.deviation, 1e-9);
        EXPECT_NEAR(got.max, expected.max, 1e-12);
      }
    }
  }
}

TEST(PathSpacing, OfARasterIsItsPitchWhateverTheStep) {
  for (const double step : {0.1, 0.35, 0.7}) {
    for (const bool serpentine : {true, false}) {
      RasterOptions raster;
      raster.pitch = 0.7;
      raster.step = step;
      raster.serpentine = serpentine;
      const PathSpacing spacing = path_spacing(raster_path(test::full_map(13, 22, 0.5, 0.7, {40.0, -3.0}), raster));
      EXPECT_EQ(spacing.alone, 0);
      EXPECT_NEAR(spacing.min, 0.7, 1e-9);
      if (serpentine) {  // two corners of the outermost lines see farther
        EXPECT_GT(spacing.max, 0.7 + 1e-9);
        EXPECT_LE(spacing.max, 1.4 + 1e-9);
        EXPECT_NEAR(spacing.mean, 0.7, 0.01);
        EXPECT_LE(spacing.deviation, 0.07);
      } else {
        EXPECT_NEAR(spacing.max, 0.7, 1e-9);
        EXPECT_NEAR(spacing.mean, 0.7, 1e-9);
        EXPECT_NEAR(spacing.deviation, 0.0, 1e-7);
      }
    }
  }
}

TEST(PathSpacing, APathWithoutNeighbourHasNone) {
  ToolPath line;
  for (int k = 0; k < 9; ++k) line.points.push_back({0.5 * k, 1.0});
  line.lifted.assign(9, 0);
  const PathSpacing spacing = path_spacing(line);
  EXPECT_EQ(spacing.points, 0);
  EXPECT_EQ(spacing.alone, 9);
  EXPECT_EQ(spacing.min, 0.0);
  EXPECT_EQ(spacing.max, 0.0);
  line.points.resize(1);
  line.lifted.resize(1);
  EXPECT_EQ(path_spacing(line).alone, 1);
}

TEST(PathSpacing, LooksNoFartherThanItsReach) {
  RasterOptions raster;
  raster.pitch = 2.0;
  raster.step = 0.5;
  const ToolPath path = raster_path(test::full_map(13, 22, 0.5, 0.7, {40.0, -3.0}), raster);
  SpacingOptions options;
  options.reach = 1.9;
  EXPECT_EQ(path_spacing(path, options).points, 0);
  options.reach = 2.0 + 1e-9;
  const PathSpacing within = path_spacing(path, options), all = path_spacing(path);
  EXPECT_GT(within.points, all.points / 2);
  EXPECT_NEAR(within.max, 2.0, 1e-9);
  EXPECT_EQ(within.min, all.min);
  options.reach = 0.0;
  EXPECT_EQ(message_of([&] { path_spacing(path, options); }), "path spacing: reach = 0 mm; required > 0");
}

TEST(PathSpacing, RefusesBadOptionsAndPaths) {
  ToolPath path;
  path.points = {{0, 0}, {1, 0}};
  path.lifted = {1, 0};
  EXPECT_EQ(message_of([&] { path_spacing(path, {0, 2.0}); }), "path spacing: skip = 0; required >= 1");
  for (const double detour : {0.5, kNaN, kInf}) {
    EXPECT_NE(message_of([&] { path_spacing(path, {1, detour}); }).find("required finite and >= 1"), std::string::npos);
  }
  path.points[1].y = kNaN;
  EXPECT_NE(message_of([&] { path_spacing(path); }).find("point 2"), std::string::npos);
}

}  // namespace
}  // namespace dwell
