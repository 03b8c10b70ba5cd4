#include "runs/reports/map_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runs/drawing/colour.h"
#include "tests/core/base/expect_error.h"
#include "tests/runs/drawing/decoded_png.h"

namespace dwell {
namespace {

/// 2 x - 3 y with a hole; x 10 to 13 mm, y -4 to -2 mm.
HeightMap plane() {
  HeightMap map(Grid{5, 7, 0.5, 0.5, {10.0, -4.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    map.values[static_cast<std::size_t>(i)] = 2.0 * map.grid.centre(i).x - 3.0 * map.grid.centre(i).y;
  }
  map.at(1, 4) = std::nan("");
  return map;
}

TEST(MapProfile, AlongAnAxisTakesTheNearestPixels) {
  const MapProfile x = map_profile(plane(), parse_profile_spec("y=-3.4"));
  EXPECT_EQ(x.name, "y = -3.5 mm");
  EXPECT_EQ(x.position, "x");
  ASSERT_EQ(x.heights.size(), 7u);
  EXPECT_EQ(x.places[6], 13.0);
  EXPECT_EQ(x.heights[6], 26.0 + 10.5);
  EXPECT_TRUE(std::isnan(x.heights[4]));
  EXPECT_NEAR(x.pv(), 6.0, 1e-12);
  const MapProfile y = map_profile(plane(), parse_profile_spec("x=10.2"));
  EXPECT_EQ(y.name, "x = 10 mm");
  ASSERT_EQ(y.heights.size(), 5u);
  EXPECT_EQ(y.heights[4], 20.0 + 6.0);
  EXPECT_NEAR(y.rms(), 1.5 * std::sqrt(2.0), 1e-12);                        // 26, 27.5, ... 32 about 29
  EXPECT_NEAR(x.rms(), std::sqrt(75.0 / 6.0 - 17.0 * 17.0 / 36.0), 1e-12);  // 0, 1, 2, 3, 5, 6 above the first
}

TEST(MapProfile, BetweenTwoPointsInterpolates) {
  const MapProfile line = map_profile(plane(), parse_profile_spec("10.1,-2.1,12.9,-3.9"));
  EXPECT_EQ(line.position, "distance");
  EXPECT_NEAR(line.places.back(), std::hypot(2.8, 1.8), 1e-12);
  std::size_t missing = 0;
  for (std::size_t k = 0; k < line.places.size(); ++k) {
    const double share = line.places[k] / line.places.back();
    const double expected = 2.0 * (10.1 + 2.8 * share) - 3.0 * (-2.1 - 1.8 * share);
    if (std::isnan(line.heights[k])) {
      ++missing;
    } else {
      EXPECT_NEAR(line.heights[k], expected, 1e-12);
    }
  }
  EXPECT_GE(missing, 1u);
  EXPECT_LT(missing, line.places.size() / 2);
}

TEST(MapProfile, RefusesLinesOffTheMapAndWithoutData) {
  const HeightMap map = plane();
  for (const char* text : {"y=-1.7", "x=9.7", "10,-3,14,-3", "10,-5,12,-3"}) {
    test::expect_input_error([&] { map_profile(map, parse_profile_spec(text)); }, {"does not lie on the map", "9.75"});
  }
  HeightMap hole = map;
  for (Index c = 0; c < 7; ++c) hole.at(2, c) = std::nan("");
  test::expect_input_error([&] { map_profile(hole, parse_profile_spec("y=-3")); }, {"no pixel that has data"});
  for (const char* text : {"", "y", "y=", "z=3", "y=nan", "1,2,3", "1,2,1,2", "1,2,3,inf"}) {
    test::expect_input_error([&] { parse_profile_spec(text); }, {text, "X0,Y0,X1,Y1"});
  }
}

TEST(MapProfile, PictureIsCutAtTheHole) {
  const auto picture = testing::decode_png(profile_picture(map_profile(plane(), parse_profile_spec("y=-3.5")), "t"));
  std::size_t blue = 0;
  bool gap = false;
  int first = picture.width, last = 0;
  std::vector<bool> column(static_cast<std::size_t>(picture.width), false);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (picture.at(x, y) != Colour{33, 102, 172}) continue;
      ++blue, column[static_cast<std::size_t>(x)] = true;
      first = std::min(first, x), last = std::max(last, x);
    }
  }
  for (int x = first; x < last; ++x) gap = gap || !column[static_cast<std::size_t>(x)];
  EXPECT_GT(blue, 500u);
  EXPECT_TRUE(gap);
}

}  // namespace
}  // namespace dwell
