#include "paths/path_domain.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/paths/path_test_util.h"

namespace dwell {
namespace {

TEST(PathDomain, HoldsWhatIsWithinReachOfAValidPixel) {
  const HeightMap map = test::map_from_picture({"..11...", ".111...", ".....1."}, 0.5, {-1.0, 3.0});
  const PathDomain domain(map, 0.8, "raster");
  EXPECT_EQ(domain.box().low, (Point{-0.5, 3.0}));
  EXPECT_EQ(domain.box().high, (Point{1.5, 4.0}));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-3.0, 4.0), y(1.0, 6.0);
  int inside = 0;
  for (int k = 0; k < 2000; ++k) {
    const Point p{x(random), y(random)};
    EXPECT_EQ(domain.contains(p), test::brute_force_distance(map, p) <= 0.8) << p.x << ' ' << p.y;
    inside += domain.contains(p);
  }
  EXPECT_GT(inside, 100);
}

TEST(PathDomain, HoldsPointsExactlyAtItsReach) {
  const PathDomain domain(test::full_map(1, 4, 0.1, 0.1, {0.3, 0.7}), 0.3, "raster");
  EXPECT_TRUE(domain.contains({0.3, 1.0}));
  EXPECT_TRUE(domain.contains({0.0, 0.7}));
  EXPECT_FALSE(domain.contains({-1e-6, 0.7}));
}

TEST(PathDomain, RefusesWhatIsNone) {
  const HeightMap map = test::full_map(2, 3);
  EXPECT_EQ(test::message_of([&] { PathDomain(map, -1.0, "spiral"); }),
            "spiral: overrun = -1 mm; required finite and >= 0");
  EXPECT_EQ(test::message_of([&] { PathDomain(map, test::kNaN, "spiral", "reach"); }),
            "spiral: reach = nan mm; required finite and >= 0");
  EXPECT_EQ(test::message_of([&] { PathDomain(test::map_from_picture({"...", "..."}), 1.0, "spiral"); }),
            "spiral: the map has no finite pixel; at least one is required");
}

}  // namespace
}  // namespace dwell
