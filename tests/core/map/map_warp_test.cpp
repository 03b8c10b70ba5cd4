#include "core/map/map_warp.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/grid_limit.h"
#include "core/map/map_sampler.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

using test::kNoData;
using test::map_of;
using test::uneven_map;

TEST(MapSampler, TakesTheHeightsAtThePixelsAndHasNoDataInCellsOfAHole) {
  const HeightMap map = uneven_map();
  const MapSampler sampler(map);
  for (Index r = 0; r < map.grid.rows; ++r) {
    for (Index c = 0; c < map.grid.cols; ++c) {
      const Point p = map.grid.centre(r, c);
      if (std::isfinite(map.at(r, c))) {
        EXPECT_NEAR(sampler(p), map.at(r, c), 1e-11);
      } else {
        EXPECT_TRUE(std::isnan(sampler(p)));
      }
      if (r + 1 == map.grid.rows || c + 1 == map.grid.cols) continue;
      const bool all = std::isfinite(map.at(r, c) + map.at(r, c + 1) + map.at(r + 1, c) + map.at(r + 1, c + 1));
      EXPECT_EQ(std::isfinite(sampler(p + Point{0.1, 0.15})), all) << r << " " << c;
      EXPECT_EQ(std::isfinite(sampler(p + Point{0.1, 0.0})), std::isfinite(map.at(r, c) + map.at(r, c + 1)));
    }
  }
  EXPECT_TRUE(std::isnan(sampler({-1.11, 2.5})));
  EXPECT_TRUE(std::isnan(sampler({1e300, 2.5})));
  EXPECT_TRUE(std::isnan(sampler({kNoData, 2.5})));
}

TEST(MapSampler, FollowsASmoothSurfaceBetweenPixelsUpToTheEdgeOfItsData) {
  const auto height = [](double x, double y) { return 40.0 * std::sin(0.31 * x + 0.2) * std::cos(0.23 * y) + 3.0 * x; };
  HeightMap map = map_of({60, 90, 0.3, 0.4, {-11.0, 3.0}}, height);
  for (Index r = 20; r < 29; ++r) {
    for (Index c = 40; c < 46; ++c) map.at(r, c) = kNoData;
  }
  const MapSampler sampler(map);
  double worst = 0.0, worst_inside = 0.0, worst_slope = 0.0;
  for (double x = -11.0; x < 15.7; x += 0.0713) {
    for (double y = 3.0; y < 26.6; y += 0.0931) {
      if (!sampler.has_data({x, y})) continue;
      const double error = std::abs(sampler({x, y}) - height(x, y));
      worst = std::max(worst, error);
      if (x > -9.0 && x < -1.0 && y > 5.0 && y < 24.0) worst_inside = std::max(worst_inside, error);
      const SplineSurface::Jet jet = sampler.jet({x, y});
      EXPECT_NEAR(jet.value, sampler({x, y}), 1e-11);
      worst_slope = std::max(worst_slope,
                             std::abs(jet.by_x - (40.0 * 0.31 * std::cos(0.31 * x + 0.2) * std::cos(0.23 * y) + 3.0)));
    }
  }
  // Linear continuation misses a fifth of the second difference, 0.35 nm, at a corner; five pixels away nothing is
  // left.
  EXPECT_LE(worst, 0.1);
  EXPECT_LE(worst_inside, 1e-3);
  EXPECT_GT(worst_inside, 0.0);
  EXPECT_LE(worst_slope, 0.7);  // of 12.4 nm/mm
}

TEST(MapSampler, SlopesAreThoseOfItsSurface) {
  const MapSampler sampler(uneven_map());
  constexpr double kStep = 1e-5;
  for (const Point p : {Point{-0.7, 3.1}, Point{1.234, 2.71}, Point{0.5, 3.0}, Point{2.75, 2.35}}) {
    const SplineSurface::Jet jet = sampler.jet(p);
    const auto height = [&](double dx, double dy) { return sampler.jet(p + Point{dx, dy}).value; };
    EXPECT_NEAR(jet.by_x, (height(kStep, 0) - height(-kStep, 0)) / (2 * kStep), 1e-6);
    EXPECT_NEAR(jet.by_y, (height(0, kStep) - height(0, -kStep)) / (2 * kStep), 1e-6);
  }
}

TEST(MapWarp, IdentityOntoItsOwnGridChangesNothing) {
  const HeightMap map = uneven_map();
  const HeightMap same = warp_map(map, {}, map.grid);
  EXPECT_EQ(same.valid_pixels(), map.valid_pixels());
  EXPECT_EQ(same.history, map.history);
  for (const Index i : finite_pixels(map)) {
    EXPECT_NEAR(same.values[static_cast<std::size_t>(i)], map.values[static_cast<std::size_t>(i)], 1e-11);
  }
}

TEST(MapWarp, RotatesABumpCounterClockwiseToWhereTheFormulaSays) {
  const Grid grid{81, 121, 0.25, 0.3, {-7.0, 11.0}};
  const Point bump{4.0, 20.0}, middle = middle_of(grid);
  const auto height = [](Point centre) {
    return [centre](double x, double y) { return 100.0 * std::exp(-std::pow(distance({x, y}, centre), 2) / 4.0); };
  };
  const HeightMap map = map_of(grid, height(bump));
  for (const double degrees : {20.0, -35.0, 145.0}) {
    for (const Point about : {middle, Point{}, Point{3.0, -2.0}}) {
      const double angle = degrees * std::numbers::pi / 180.0;
      const Point d = bump - about;
      const Point there =
          about + Point{std::cos(angle) * d.x - std::sin(angle) * d.y, std::sin(angle) * d.x + std::cos(angle) * d.y};
      const HeightMap result = rotate_map(map, degrees, about, 2);
      const HeightMap expected = map_of(result.grid, height(there));
      EXPECT_GT(result.valid_pixels(), 9 * grid.size() / 10);
      double worst = 0.0;
      for (const Index i : finite_pixels(result)) {
        const auto k = static_cast<std::size_t>(i);
        worst = std::max(worst, std::abs(result.values[k] - expected.values[k]));
      }
      EXPECT_LE(worst, 0.02);
    }
  }
}

TEST(MapWarp, CoveringGridHoldsAllMovedPixels) {
  const Grid grid = uneven_map().grid;
  const PlaneTransform forward = similarity({1.0, 2.0}, {0.3, -4.0}, 33.0, 1.2);
  const Grid cover = covering_grid(grid, forward);
  EXPECT_EQ(cover.pitch_x, grid.pitch_x);
  EXPECT_EQ(cover.pitch_y, grid.pitch_y);
  Point low{1e9, 1e9}, high{-1e9, -1e9};
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = forward(grid.centre(i));
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  EXPECT_LE(cover.x(0), low.x + 1e-12);
  EXPECT_LE(cover.y(0), low.y + 1e-12);
  EXPECT_GE(cover.x(cover.cols - 1), high.x - 1e-12);
  EXPECT_GE(cover.y(cover.rows - 1), high.y - 1e-12);
  EXPECT_LE(cover.width(), high.x - low.x + 2 * grid.pitch_x);
  EXPECT_LE(cover.height(), high.y - low.y + 2 * grid.pitch_y);
}

TEST(MapWarp, RefusesWhatItCannotMove) {
  const HeightMap map = uneven_map();
  test::expect_input_error([&] { warp_map(map, {1, 2, 2, 4, {}}, map.grid); }, {"determinant 0"});
  test::expect_input_error([&] { warp_map(map, {1, 0, 0, 1, {50, 0}}, map.grid); }, {"no data", "overlap"});
  test::expect_input_error([&] { covering_grid(map.grid, similarity({}, {}, 0.0, 1e6)); }, {"pixels are accepted"});
}

TEST(PlaneTransform, InverseUndoesIt) {
  const PlaneTransform t{1.2, -0.3, 0.7, 0.4, {5.0, -6.0}};
  for (const Point p : {Point{}, Point{3.0, -8.0}}) EXPECT_LE(distance(t.inverse()(t(p)), p), 1e-12);
  const PlaneTransform s = similarity({2.0, 1.0}, {0.5, 0.0}, 90.0, 2.0);
  EXPECT_LE(distance(s({3.0, 1.0}), {2.5, 3.0}), 1e-12);
}

TEST(MapWarp, StopsWhenAsked) {
  const HeightMap map(Grid{40, 30, 0.5, 0.5, {}}, std::vector<double>(1200, 1.0));
  const Progress stop{{}, [] { return true; }};
  EXPECT_THROW(warp_map(map, {}, map.grid, 1, stop), Interrupted);
  EXPECT_THROW(rotate_map(map, 33.0, {}, 2, {}, stop), Interrupted);
  std::vector<std::string> lines;
  const Progress listener{[&](const std::string& line) { lines.push_back(line); }, {}};
  warp_map(map, {}, map.grid, 1, listener);
  EXPECT_EQ(lines, (std::vector<std::string>{"the spline through the map", "resampling: 0 %"}));
}

}  // namespace
}  // namespace dwell
