#include "core/map/scattered_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

/// Points at random over 20 x 12 mm with a round hole, on a surface.
template <class Surface>
std::vector<HeightPoint> scattered(int count, Surface surface) {
  std::mt19937 dice(7);
  std::uniform_real_distribution<double> x(-3.0, 17.0), y(2.0, 14.0);
  std::vector<HeightPoint> points;
  while (static_cast<int>(points.size()) < count) {
    const Point at{x(dice), y(dice)};
    if (std::hypot(at.x - 9.0, at.y - 7.0) < 2.5) continue;
    points.push_back({at, surface(at)});
  }
  return points;
}

double wavy(Point p) { return 40.0 * std::sin(0.5 * p.x + 0.2) * std::cos(0.35 * p.y) + 3.0 * p.x - 0.4 * p.x * p.y; }

HeightMap gridded(const std::vector<HeightPoint>& points, double pitch, ScatterSummary& summary,
                  std::optional<double> reach = {}, int threads = 1) {
  return scattered_surface(points, grid_over(points, pitch, {}), {pitch, reach}, summary, threads);
}

/// The same fit by brute force: all points sorted by distance, normal equations, Gaussian elimination in long double.
/// NaN where fewer than `terms` points serve.
double oracle_height(const std::vector<HeightPoint>& points, Point place, double radius) {
  struct At {
    double distance;
    HeightPoint point;
  };
  std::vector<At> sorted;
  for (const HeightPoint& p : points) {
    sorted.push_back({std::hypot(p.position.x - place.x, p.position.y - place.y), p});
  }
  std::sort(sorted.begin(), sorted.end(), [](const At& a, const At& b) { return a.distance < b.distance; });
  int taken[8] = {};
  long double a[6][7] = {};
  for (const auto& [distance, p] : sorted) {
    if (distance > radius) break;
    const double degrees = std::atan2(p.position.y - place.y, p.position.x - place.x) * 180.0 / std::numbers::pi;
    const int sector = std::min(static_cast<int>((degrees + 180.0) / 45.0), 7);
    if (++taken[sector] > 3) continue;
    const long double w = std::pow(1.0L - static_cast<long double>(distance) * distance / radius / radius, 2);
    const long double u = p.position.x - place.x, v = p.position.y - place.y;
    const long double terms[7] = {1, u, v, u * u, u * v, v * v, p.height};
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 7; ++j) a[i][j] += w * terms[i] * terms[j];
    }
  }
  for (int k = 0; k < 6; ++k) {
    for (int i = 0; i < 6; ++i) {
      if (i == k) continue;
      const long double factor = a[i][k] / a[k][k];
      for (int j = k; j < 7; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  return static_cast<double>(a[0][6] / a[0][0]);
}

TEST(ScatteredSurface, ReproducesQuadraticsExactly) {
  const auto quadratic = [](Point p) {
    return 5.0 - 2.0 * p.x + 0.7 * p.y + 0.3 * p.x * p.x - 0.2 * p.x * p.y + 0.1 * p.y * p.y;
  };
  const auto points = scattered(600, quadratic);
  ScatterSummary summary;
  const HeightMap map = gridded(points, 0.5, summary);
  EXPECT_GT(summary.pixels, 800);
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      if (std::isnan(map.at(row, col))) continue;
      EXPECT_NEAR(map.at(row, col), quadratic(map.grid.centre(row, col)), 1e-9);
    }
  }
}

TEST(ScatteredSurface, AgreesWithBruteForceAndWithTheSurface) {
  const auto points = scattered(700, wavy);
  ScatterSummary summary;
  const HeightMap map = gridded(points, 0.7, summary, {}, 2);
  double sum = 0.0;
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      if (std::isnan(map.at(row, col))) continue;
      const Point at = map.grid.centre(row, col);
      // An oracle that solves the normal equations of a quadratic cannot follow where a plane was taken, at an edge.
      EXPECT_NEAR(map.at(row, col), oracle_height(points, at, 3.0 * summary.reach), 1e-6) << row << " " << col;
      sum += std::pow(map.at(row, col) - wavy(at), 2);
    }
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(summary.pixels)), 0.3) << "of an amplitude of 40";
}

TEST(ScatteredSurface, HasDataWherePointsAreNearAndAround) {
  const auto points = scattered(700, wavy);
  ScatterSummary summary;
  const HeightMap map = gridded(points, 0.25, summary);
  // 20 x 12 mm less the hole hold 700 points.
  EXPECT_NEAR(summary.spacing, std::sqrt((20.0 * 12.0 - std::numbers::pi * 6.25) / 700.0), 0.05);
  EXPECT_DOUBLE_EQ(summary.reach, 1.5 * summary.spacing);
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      const Point at = map.grid.centre(row, col);
      double nearest = HUGE_VAL;
      for (const HeightPoint& p : points)
        nearest = std::min(nearest, std::hypot(p.position.x - at.x, p.position.y - at.y));
      const bool within = nearest <= summary.reach;
      if (!within) {
        EXPECT_TRUE(std::isnan(map.at(row, col))) << at.x << " " << at.y;
      }
      const bool inside =
          at.x > -2.0 && at.x < 16.0 && at.y > 3.0 && at.y < 13.0 && std::hypot(at.x - 9.0, at.y - 7.0) > 3.5;
      if (inside && within) {
        EXPECT_FALSE(std::isnan(map.at(row, col))) << at.x << " " << at.y;
      }
    }
  }
  EXPECT_TRUE(std::isnan(map.at(map.grid.rows * 5 / 12, map.grid.cols * 12 / 20))) << "the middle of the hole";
  ScatterSummary tight;
  gridded(points, 0.25, tight, 0.3);
  EXPECT_LT(tight.pixels, summary.pixels / 2 * 2 - 100);
  EXPECT_EQ(tight.reach, 0.3);
}

TEST(ScatteredSurface, ServesDenseTracksFarApart) {
  std::vector<HeightPoint> points;
  for (int track = 0; track < 9; ++track) {
    for (int i = 0; i < 400; ++i) {
      const Point at{0.04 * i + 0.01 * (track % 3), 1.5 * track + 0.02 * std::sin(0.3 * i)};
      points.push_back({at, wavy(at)});
    }
  }
  ScatterSummary summary;
  const HeightMap map = gridded(points, 0.5, summary, 1.5);
  double worst = 0.0;
  Index inside = 0;
  for (Index row = 4; row + 4 < map.grid.rows; ++row) {
    for (Index col = 3; col + 3 < map.grid.cols; ++col, ++inside) {
      worst = std::max(worst, std::abs(map.at(row, col) - wavy(map.grid.centre(row, col))));
    }
  }
  EXPECT_GT(inside, 300);
  EXPECT_LT(worst, 3.0) << "of an amplitude of 40";
}

TEST(ScatteredSurface, StandsStillWhereItIsAsked) {
  std::vector<HeightPoint> points{{{1.0, 2.0}, 1.0}, {{4.3, 2.0}, 1.0}, {{1.0, 7.9}, 1.0}};
  EXPECT_EQ(grid_over(points, 0.5, {}), (Grid{12, 7, 0.5, 0.5, {1.0, 2.0}}));
  EXPECT_EQ(grid_over(points, 0.5, Point{0.5, 1.5}), (Grid{13, 8, 0.5, 0.5, {0.5, 1.5}}));
  test::expect_input_error([&] { grid_over(points, 0.5, {}, {50.0}); }, {"12 x 7 pixels"});
}

TEST(ScatteredSurface, RefusesWhatDeterminesNoSurfaceAndStops) {
  std::vector<HeightPoint> points = scattered(5, wavy);
  ScatterSummary summary;
  test::expect_input_error([&] { gridded(points, 0.5, summary); }, {"5 points", "at least 6"});
  points.assign(20, {{1.0, 1.0}, 3.0});
  test::expect_input_error([&] { gridded(points, 0.5, summary); }, {"one place"});
  points = scattered(50, wavy);
  test::expect_input_error([&] { gridded(points, 1e-9, summary); }, {"pixels are accepted"});
  std::vector<HeightPoint> line;
  for (int i = 0; i < 20; ++i) line.push_back({{0.5 * i, 1.0 + 0.1 * i}, 2.0});
  EXPECT_EQ(gridded(line, 0.5, summary).valid_pixels(), 0);
  int asked = 0;
  Progress stop;
  stop.stop = [&] { return ++asked > 2; };
  points = scattered(500, wavy);
  EXPECT_THROW(scattered_surface(points, grid_over(points, 0.02, {}), {0.02, {}}, summary, 1, stop), Interrupted);
}

}  // namespace
}  // namespace dwell
