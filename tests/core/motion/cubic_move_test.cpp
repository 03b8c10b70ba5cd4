#include "core/motion/cubic_move.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dwell {
namespace {

const CubicMove kBent{{1.0, -2.0}, {3.5, 0.5}, {2.0, 0.5}, {0.0, 3.0}, 1.25};

TEST(CubicMove, PassesItsEndsWithTheirSpeeds) {
  EXPECT_EQ(kBent.place(0.0), kBent.start);
  EXPECT_NEAR(distance(kBent.place(1.25), kBent.finish), 0.0, 1e-15);
  EXPECT_EQ(kBent.speed(0.0), kBent.speed_in);
  EXPECT_NEAR(distance(kBent.speed(1.25), kBent.speed_out), 0.0, 1e-15);
}

TEST(CubicMove, HasTheDerivativesOfItsPlaces) {
  constexpr double kStep = 1e-5;
  for (const double t : {0.1, 0.4, 0.9}) {
    const Point v = (0.5 / kStep) * (kBent.place(t + kStep) - kBent.place(t - kStep));
    const Point a = (0.5 / kStep) * (kBent.speed(t + kStep) - kBent.speed(t - kStep));
    EXPECT_NEAR(distance(v, kBent.speed(t)), 0.0, 1e-8);
    EXPECT_NEAR(distance(a, kBent.acceleration(t)), 0.0, 1e-8);
  }
}

TEST(CubicMove, FindsItsLargestSpeedAndAcceleration) {
  Point v{0.0, 0.0}, a{0.0, 0.0};
  for (int k = 0; k <= 20'000; ++k) {
    const double t = 1.25 * k / 20'000;
    v = {std::max(v.x, std::abs(kBent.speed(t).x)), std::max(v.y, std::abs(kBent.speed(t).y))};
    a = {std::max(a.x, std::abs(kBent.acceleration(t).x)), std::max(a.y, std::abs(kBent.acceleration(t).y))};
  }
  EXPECT_NEAR(largest_speed(kBent).x, v.x, 1e-6);
  EXPECT_NEAR(largest_speed(kBent).y, v.y, 1e-6);
  EXPECT_NEAR(distance(largest_acceleration(kBent), a), 0.0, 1e-12);
}

TEST(CubicMove, IsAStraightMoveAtConstantAcceleration) {
  // From 1 to 3 mm/s over 4 mm: 2 s at 1 mm/s^2.
  const Point along{0.6, -0.8};
  const CubicMove move{{0.0, 1.0}, Point{0.0, 1.0} + 4.0 * along, along, 3.0 * along, 2.0};
  for (const double t : {0.0, 0.3, 1.1, 2.0}) {
    EXPECT_NEAR(distance(move.place(t), Point{0.0, 1.0} + (t + 0.5 * t * t) * along), 0.0, 1e-14);
    EXPECT_NEAR(distance(move.acceleration(t), along), 0.0, 1e-14);
  }
  EXPECT_EQ(places_on({{0, 0}, {2, 0}, {1, 0}, {1, 0}, 2.0}, 12.0).size(), 2U);  // at one speed
  EXPECT_GE(places_on(move, 12.0).size(), 9U);
}

}  // namespace
}  // namespace dwell
