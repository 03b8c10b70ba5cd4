#include "core/map/map_arithmetic.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"
#include "tests/core/map/same_map.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::kNoData;
using test::uneven_map;

const Grid kGrid{2, 3, 0.3, 0.2, {-1.0, 4.0}};

TEST(MapDifference, SubtractsWhereBothHaveData) {
  const HeightMap a(kGrid, {1, 2, kNoData, 4, 5, 6}), b(kGrid, {10, kNoData, 30, 1, 1, 8});
  test::expect_same_map(difference(a, b), HeightMap(kGrid, {-9, kNoData, kNoData, 3, 4, -2}));
  expect_input_error(
      [&] {
        difference(HeightMap(kGrid, {1, 2, 3, kNoData, kNoData, kNoData}),
                   HeightMap(kGrid, {kNoData, kNoData, kNoData, 1, 2, 3}));
      },
      {"no pixel"});
}

TEST(MapMean, CountsThoseThatHaveData) {
  const std::vector<HeightMap> maps{HeightMap(kGrid, {1, 2, kNoData, 4, kNoData, kNoData}),
                                    HeightMap(kGrid, {3, kNoData, 7, 5, kNoData, kNoData}),
                                    HeightMap(kGrid, {8, 6, kNoData, 9, 2, kNoData})};
  test::expect_same_map(mean_map(maps, 3), HeightMap(kGrid, {4, kNoData, kNoData, 6, kNoData, kNoData}));
  test::expect_same_map(mean_map(maps, 2), HeightMap(kGrid, {4, 4, kNoData, 6, kNoData, kNoData}));
  test::expect_same_map(mean_map(maps, 1), HeightMap(kGrid, {4, 4, 7, 6, 2, kNoData}));
  expect_input_error([&] { mean_map(maps, 4); }, {"least = 4 of 3", "1 to 3"});
  expect_input_error([&] { mean_map(maps, 0); }, {"least = 0"});
}

TEST(MapGrids, AgreeToAMillionthOfThePitch) {
  EXPECT_EQ(grid_difference(kGrid, kGrid), "");
  Grid other = kGrid;
  other.origin.x += 0.9e-6 * kGrid.pitch_x;
  EXPECT_EQ(grid_difference(kGrid, other), "");
  const auto differs = [](auto change) {
    Grid grid = kGrid;
    change(grid);
    EXPECT_NE(grid_difference(kGrid, grid), "");
    expect_input_error(
        [&] {
          difference(HeightMap(kGrid, {1, 2, 3, 4, 5, 6}),
                     HeightMap(grid, std::vector<double>(static_cast<std::size_t>(grid.size()))));
        },
        {"different grids", "1e-6 pixels"});
  };
  differs([](Grid& g) { g.origin.x += 2e-6 * g.pitch_x; });
  differs([](Grid& g) { g.origin.y -= 2e-6 * g.pitch_y; });
  differs([](Grid& g) { g.pitch_x *= 1.0 + 2e-6; });
  differs([](Grid& g) { g.pitch_y *= 1.0 - 2e-6; });
  differs([](Grid& g) { g.rows = 3; });
  differs([](Grid& g) { std::swap(g.rows, g.cols); });
  // Equal pitches to 1e-6 add up over many pixels.
  const Grid wide{3, 1000, 0.3, 0.2, {}}, stretched{3, 1000, 0.3 * (1.0 + 1e-8), 0.2, {}};
  EXPECT_NE(grid_difference(wide, stretched), "");
}

}  // namespace
}  // namespace dwell
