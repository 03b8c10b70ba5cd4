#include "paths/domain/widest_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

/// Every valid pixel against every missing one and the frame.
WidestPlace by_looking_at_all(const HeightMap& map) {
  WidestPlace best;
  const Grid& g = map.grid;
  for (Index r = 0; r < g.rows; ++r) {
    for (Index c = 0; c < g.cols; ++c) {
      if (!std::isfinite(map.at(r, c))) continue;
      double room = test::kInf;
      for (Index y = -1; y <= g.rows; ++y) {
        for (Index x = -1; x <= g.cols; ++x) {
          const bool inside = y >= 0 && x >= 0 && y < g.rows && x < g.cols;
          if (inside && std::isfinite(map.at(y, x))) continue;
          room = std::min(room, distance(g.centre(r, c), {g.x(x), g.y(y)}));
        }
      }
      if (room > best.radius * (1.0 + 1e-12)) best = {g.centre(r, c), room};
    }
  }
  return best;
}

TEST(WidestPlace, IsWhereADiscHasMostRoom) {
  std::mt19937 random(5);
  for (int k = 0; k < 40; ++k) {
    HeightMap map = test::full_map(9 + k % 5, 14, 0.7, 1.1, {-3.0, 2.0});
    for (int hole = 0; hole < k / 2; ++hole) {
      map.values[random() % map.values.size()] = test::kNaN;
    }
    const WidestPlace expected = by_looking_at_all(map), place = widest_place(map);
    EXPECT_NEAR(place.radius, expected.radius, 1e-9);
    EXPECT_EQ(place.centre, expected.centre) << k;
  }
}

TEST(WidestPlace, OfARingIsInTheRing) {
  HeightMap map = test::full_map(61, 61, 1.0, 1.0, {-30.0, -30.0});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const double r = length(map.grid.centre(i));
    if (r < 10.0 || r > 30.0) map.values[static_cast<std::size_t>(i)] = test::kNaN;
  }
  const WidestPlace place = widest_place(map);
  EXPECT_NEAR(length(place.centre), 20.0, 1.5);
  EXPECT_NEAR(place.radius, 10.0, 1.5);
}

TEST(WidestPlace, RefusesAnEmptyMap) {
  EXPECT_NE(test::message_of([] {
              widest_place(test::map_from_picture({"...", "..."}));
            }).find("no finite pixel"),
            std::string::npos);
}

}  // namespace
}  // namespace dwell
