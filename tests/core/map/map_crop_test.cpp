#include "core/map/map_crop.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"
#include "tests/core/map/same_map.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::kNoData;
using test::uneven_map;

TEST(MapCrop, KeepsThePixelsOfTheRectangleWhereTheyAre) {
  const HeightMap map = uneven_map();
  // x of columns: -1.1 + 0.3 c; 0.4 and 1.9 are those of columns 5 and 10. y of rows: 2.3 + 0.2 r.
  const HeightMap part = crop(map, {0.4, 2.65}, {1.9, 3.55});
  EXPECT_EQ(part.grid.cols, 6);
  EXPECT_EQ(part.grid.rows, 5);
  EXPECT_EQ(part.history, map.history);
  for (Index r = 0; r < part.grid.rows; ++r) {
    for (Index c = 0; c < part.grid.cols; ++c) {
      EXPECT_LE(distance(part.grid.centre(r, c), map.grid.centre(r + 2, c + 5)), 1e-12);
      const double a = part.at(r, c), b = map.at(r + 2, c + 5);
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
    }
  }
  test::expect_same_map(crop(map, {-1e300, -1e300}, {1e300, 1e300}), map);
}

TEST(MapCrop, ToTheDataLeavesNoEmptyBorder) {
  HeightMap map(Grid{7, 9, 0.3, 0.2, {-1.0, 5.0}});
  map.at(2, 3) = 1.0;
  map.at(5, 4) = 2.0;
  map.at(3, 7) = 3.0;
  const HeightMap part = crop_to_data(map);
  const HeightMap expected(Grid{4, 5, 0.3, 0.2, map.grid.centre(2, 3)},
                           {1.0,     kNoData, kNoData, kNoData, kNoData, kNoData, kNoData, kNoData, kNoData, 3.0,
                            kNoData, kNoData, kNoData, kNoData, kNoData, kNoData, 2.0,     kNoData, kNoData, kNoData});
  test::expect_same_map(part, expected);
}

TEST(MapCrop, RefusesToLeaveNothing) {
  const HeightMap map = uneven_map();
  for (const auto& [low, high] : {std::pair{Point{50, 2.5}, Point{60, 3}},
                                  {Point{-1, 2.4}, Point{2, 2.45}},
                                  {Point{0.4, 2.9}, Point{1.0, 2.9}},
                                  {Point{-1e300, -1e300}, Point{-1e299, 1e300}}}) {
    expect_input_error([&, lo = low, hi = high] { crop(map, lo, hi); }, {"no pixel with data", "x = -1.1 to 2.8"});
  }
  expect_input_error([] { crop_to_data(HeightMap(Grid{2, 3, 1, 1, {}})); }, {"no finite pixel"});
}

}  // namespace
}  // namespace dwell
