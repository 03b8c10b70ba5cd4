#include "core/map/map_decimate.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"
#include "tests/core/map/same_map.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::kNoData;
using test::map_of;
using test::uneven_map;

TEST(BlockAverage, IsTheMeanByHandWithTheHalfRule) {
  // Blocks of 2 rows x 3 columns: 6 pixels, 3 of them needed.
  const double n = kNoData;
  const HeightMap map(Grid{3, 8, 0.5, 0.25, {1.0, -2.0}}, {1, 2, 3, n, n, 5, 10, 20,  //
                                                           4, n, 6, n, 1, n, 30, 40,  //
                                                           7, 8, 9, 5, n, 1, 50, 60});
  const HeightMap mean = decimate_map(map, 2, 3);
  // Row 1 of blocks is half a block high: full rows of it have just half. Column 2 is two thirds wide: 4 of 6, 2 of 6.
  const HeightMap expected(Grid{2, 3, 1.5, 0.5, {1.5, -1.875}}, {3.2, n, 25.0, 8.0, n, n});
  test::expect_same_map(mean, expected);
  test::expect_same_map(decimate_map(map, 1, 1), map);
}

TEST(BlockAverage, LeavesOutBlocksThatCannotBeHalfFull) {
  const HeightMap map = map_of({7, 9, 0.3, 0.2, {}}, [](double x, double y) { return x + y; });
  EXPECT_EQ(decimate_map(map, 5, 4).grid.rows, 1);  // 2 of 5 rows left over
  EXPECT_EQ(decimate_map(map, 4, 4).grid.rows, 2);  // 3 of 4
  EXPECT_EQ(decimate_map(map, 5, 4).grid.cols, 2);  // 1 of 4
  EXPECT_EQ(decimate_map(map, 5, 6).grid.cols, 2);  // 3 of 6
}

TEST(BlockAverage, PutsTheMeanOfAPlaneWhereThePlaneHasIt) {
  const auto plane = [](double x, double y) { return 3.0 * x - 2.0 * y + 1.0; };
  const HeightMap mean = decimate_map(map_of({8, 12, 0.3, 0.2, {-1.0, 4.0}}, plane), 4, 3);
  for (Index i = 0; i < mean.grid.size(); ++i) {
    const Point p = mean.grid.centre(i);
    EXPECT_NEAR(mean.values[static_cast<std::size_t>(i)], plane(p.x, p.y), 1e-12);
  }
}

TEST(BlockAverage, RefusesFactorsThatLeaveNothing) {
  const HeightMap map = uneven_map();
  expect_input_error([&] { decimate_map(map, 0, 2); }, {"0 x 2", "at least 1 x 1"});
  expect_input_error([&] { decimate_map(map, 19, 2); }, {"too large"});
  expect_input_error([&] { decimate_map(map, Index{1} << 62, Index{1} << 62); }, {"too large"});
  HeightMap sparse(Grid{4, 4, 1, 1, {}});
  sparse.at(0, 0) = 1.0;
  expect_input_error([&] { decimate_map(sparse, 4, 4); }, {"no block"});
}

TEST(Resample, FinerKeepsTheHeightsOfTheOldPixels) {
  const HeightMap map = uneven_map();
  const HeightMap fine = resample_map(map, {0.15, 0.05}, 2);
  EXPECT_EQ(fine.grid.cols, 27);
  EXPECT_EQ(fine.grid.rows, 33);
  EXPECT_EQ(fine.grid.origin, map.grid.origin);
  for (Index r = 0; r < map.grid.rows; ++r) {
    for (Index c = 0; c < map.grid.cols; ++c) {
      const double a = fine.at(4 * r, 2 * c), b = map.at(r, c);
      EXPECT_EQ(std::isnan(a), std::isnan(b));
      if (std::isfinite(b)) {
        EXPECT_NEAR(a, b, 1e-11);
      }
    }
  }
}

TEST(Resample, CoarserAveragesFirst) {
  // A ripple of two pixels would alias to a constant of 5 without averaging; its mean is zero.
  const HeightMap map = map_of({40, 60, 0.3, 0.2, {2.0, -1.0}},
                               [](double x, double) { return std::llround((x - 2.0) / 0.3) % 2 == 0 ? 5.0 : -5.0; });
  const HeightMap coarse = resample_map(map, {0.6, 0.2});
  EXPECT_EQ(coarse.grid.cols, 30);
  EXPECT_EQ(coarse.grid.rows, 40);
  EXPECT_NEAR(coarse.grid.origin.x, 2.15, 1e-12);
  for (const double v : coarse.values) EXPECT_NEAR(v, 0.0, 1e-12);
}

TEST(Resample, FollowsASmoothSurfaceAtAnyPitch) {
  const auto height = [](double x, double y) { return 20.0 * std::sin(0.2 * x) * std::cos(0.17 * y + 0.3); };
  const HeightMap map = map_of({90, 120, 0.3, 0.2, {-7.0, 4.0}}, height);
  for (const Point pitch : {Point{0.17, 0.11}, Point{0.44, 0.37}, Point{1.0, 0.7}, Point{0.2, 0.9}}) {
    const HeightMap result = resample_map(map, pitch);
    EXPECT_EQ(result.grid.pitch_x, pitch.x);
    EXPECT_EQ(result.grid.pitch_y, pitch.y);
    EXPECT_EQ(result.valid_pixels(), result.grid.size());
    EXPECT_LE(result.grid.x(result.grid.cols - 1), map.grid.x(map.grid.cols - 1) + 1e-9);
    EXPECT_GE(result.grid.x(result.grid.cols - 1), map.grid.x(map.grid.cols - 1) - 2.0 * pitch.x);
    for (Index i = 0; i < result.grid.size(); ++i) {
      const Point p = result.grid.centre(i);
      EXPECT_NEAR(result.values[static_cast<std::size_t>(i)], height(p.x, p.y), 0.2);
      // The average over 0.9 mm takes 0.06 off a crest; half full blocks at the edge lie on a slope of 4 nm/mm.
    }
  }
}

TEST(Resample, RefusesAPitchThatIsNoneOrTooFine) {
  const HeightMap map = uneven_map();
  for (const double pitch : {0.0, -1.0, kNoData, 1.0 / 0.0}) {
    expect_input_error([&] { resample_map(map, {pitch, 0.2}); }, {"pitch", "finite and > 0"});
  }
  expect_input_error([&] { resample_map(map, {1e-6, 1e-6}); }, {"pixels are accepted"});
  expect_input_error([&] { resample_map(map, {1e4, 1e4}); }, {"no block of"});
  expect_input_error([&] { resample_map(map, {1e-9, 0.2}); }, {"1e-09", "from 1e-06 to 10000 (mm)"});
}

}  // namespace
}  // namespace dwell
