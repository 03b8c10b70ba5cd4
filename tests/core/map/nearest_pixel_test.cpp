#include "core/map/nearest_pixel.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"
#include "tests/core/map/uneven_map.h"

namespace dwell {
namespace {

TEST(NearestPixels, AreAsNearAsAnyByBruteForce) {
  for (const unsigned keep : {3u, 7u, 41u}) {
    HeightMap map = test::uneven_map(17, 23);
    unsigned state = 12345u;
    for (double& v : map.values) {
      state = state * 1664525u + 1013904223u;
      if ((state >> 16) % keep != 0) v = test::kNoData;
    }
    map.at(4, 20) = 1.0;
    const std::vector<Index> nearest = nearest_pixels(map);
    for (Index i = 0; i < map.grid.size(); ++i) {
      double best = 1e300;
      for (const Index j : finite_pixels(map)) best = std::min(best, distance(map.grid.centre(i), map.grid.centre(j)));
      const Index found = nearest[static_cast<std::size_t>(i)];
      ASSERT_TRUE(std::isfinite(map.values[static_cast<std::size_t>(found)]));
      EXPECT_NEAR(distance(map.grid.centre(i), map.grid.centre(found)), best, 1e-12);
    }
  }
}

TEST(NearestPixels, RefuseAMapWithoutData) {
  test::expect_input_error([] { nearest_pixels(HeightMap(Grid{3, 2, 1, 1, {}})); }, {"finite pixel"});
}

}  // namespace
}  // namespace dwell
