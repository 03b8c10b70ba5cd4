#include "core/map/part_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

const Grid kRectangle{3, 5, 0.5, 2.0, {10.0, -4.0}};  // x 10 to 12, y -4 to 0 mm

TEST(PartDistance, IsMeasuredFromTheRectangleOfPixelCentres) {
  EXPECT_EQ(distance_from_map(kRectangle, {11.0, -1.0}), 0.0);
  EXPECT_EQ(distance_from_map(kRectangle, {7.0, 4.0}), 5.0);
  EXPECT_EQ(distance_from_map(kRectangle, {12.5, -2.0}), 0.5);
}

TEST(PartDistance, RefusesAPointFarOffNamingAllPlaces) {
  EXPECT_EQ(farthest_from_part(kRectangle, 1.0), 1000.0);
  EXPECT_GT(farthest_from_part({1000, 1000, 1.0, 1.0, {}}, 1.0), 10'000.0);
  const auto name = [] { return std::string("a.csv: dwell point 3"); };
  EXPECT_NO_THROW(check_near_part({1012.0, -2.0}, kRectangle, 1.0, name));
  test::expect_input_error(
      [&] {
        check_near_part({1e9, -2.0}, kRectangle, 1.0, name);
      },
      {"a.csv: dwell point 3 = (1e+09, -2) mm is 1e+09 mm from the map", "x 10 to 12", "y -4 to 0 mm",
       "within 1000 mm"});
  EXPECT_THROW(check_near_part({std::nan(""), 0.0}, kRectangle, 1.0, name), InputError);
}

}  // namespace
}  // namespace dwell
