#include "paths/domain/path_domain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/paths/domain/path_test_util.h"

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

TEST(PathDomain, LooksAroundAPoint) {
  const HeightMap map = test::map_from_picture({"..11...", ".111...", "......1"}, 0.5, {-1.0, 3.0});
  const PathDomain domain(map, 1.1, "raster");
  std::mt19937 random(9);
  std::uniform_real_distribution<double> x(-9.0, 12.0), y(-7.0, 14.0), turn(0.0, 6.3), share(0.0, 1.0);
  int inside = 0, sure_outside = 0;
  for (int k = 0; k < 4000; ++k) {
    const Point p = k % 2 == 0 ? Point{x(random), y(random)} : Point{0.1 * x(random), 4.0 + 0.1 * y(random)};
    const DomainView view = domain.look(p);
    EXPECT_EQ(view.inside, domain.contains(p));
    ASSERT_GE(view.holds_for, 0.0);
    for (int i = 0; i < 20; ++i) {
      const double angle = turn(random), away = 0.999 * view.holds_for * share(random);
      const Point q = p + away * Point{std::cos(angle), std::sin(angle)};
      EXPECT_EQ(test::brute_force_distance(map, q) <= 1.1, view.inside);
    }
    inside += view.inside && view.holds_for > 0.5;
    // Far away the answer is sure nearly as far as the part: to the rectangle of the pixels' centres at least.
    if (test::brute_force_distance(map, p) > 6.0 && view.holds_for > 3.0) ++sure_outside;
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(sure_outside, 300);
}

TEST(PathDomain, RefusesWhatIsNone) {
  const HeightMap map = test::full_map(2, 3);
  EXPECT_EQ(test::message_of([&] { PathDomain(map, -1.0, "spiral"); }),
            "spiral: overrun = -1 mm; required finite and >= 0");
  EXPECT_EQ(test::message_of([&] { PathDomain(map, test::kNaN, "spiral", "reach"); }),
            "spiral: reach = nan mm; required finite and >= 0");
  EXPECT_EQ(test::message_of([&] {
              PathDomain(test::map_from_picture({"...", "..."}), 1.0, "spiral");
            }),
            "spiral: the map has no finite pixel; at least one is required");
}

}  // namespace
}  // namespace dwell
