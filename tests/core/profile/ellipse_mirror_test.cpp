#include "core/profile/ellipse_mirror.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

/// Oracle: the height at which the distances to the foci have the sum p + q, by bisection in long double.
double height_by_foci(const EllipseMirror& m, double u) {
  const long double p = m.entrance_arm, q = m.exit_arm, s = std::sin(static_cast<long double>(m.grazing)),
                    c = std::cos(static_cast<long double>(m.grazing));
  const auto excess = [&](long double z) {
    return std::hypot(u + p * c, z - p * s) + std::hypot(u - q * c, z - q * s) - (p + q);
  };
  // On the tangent the sum is too large; halfway to the line between the foci it is too small.
  long double low = 0.0L, high = (q * s * (u + p * c) + p * s * (q * c - u)) / (c * (p + q));
  for (int k = 0; k < 200; ++k) {
    const long double middle = 0.5L * (low + high);
    (excess(middle) > 0.0L ? low : high) = middle;
  }
  return static_cast<double>(0.5L * (low + high));
}

TEST(EllipseMirror, HasThePointsWhoseDistancesToTheFociAddUp) {
  for (const EllipseMirror& m : {EllipseMirror{7500.0, 2500.0, 0.0104719755}, EllipseMirror{300.0, 900.0, 0.3},
                                 EllipseMirror{500.0, 500.0, 0.05}, EllipseMirror{46000.0, 120.0, 0.003}}) {
    const double reach = 0.6 * std::min(m.entrance_arm, m.exit_arm);
    for (const double share : {-1.0, -0.31, -0.02, 0.17, 0.64, 1.0}) {
      const double u = share * reach, h = 1e-3 * reach;
      const EllipsePoint point = ellipse_at(m, u);
      EXPECT_NEAR(point.height, height_by_foci(m, u), 1e-12 * m.entrance_arm) << u;
      // Five points of the definition.
      const double slope = (8.0 * (height_by_foci(m, u + h) - height_by_foci(m, u - h)) -
                            height_by_foci(m, u + 2.0 * h) + height_by_foci(m, u - 2.0 * h)) /
                           (12.0 * h);
      EXPECT_NEAR(point.slope, slope, 1e-8 * std::abs(slope) + 1e-11) << u;
    }
  }
}

TEST(EllipseMirror, TouchesItsTangentAtThePoleWithTheRadiusOfTheImagingEquation) {
  const EllipseMirror m{7500.0, 2500.0, 0.6 * 3.14159265358979 / 180.0};
  EXPECT_EQ(ellipse_at(m, 0.0).height, 0.0);
  EXPECT_EQ(ellipse_at(m, 0.0).slope, 0.0);
  const double radius = 2.0 * 7500.0 * 2500.0 / (10000.0 * std::sin(m.grazing)), u = 1e-3;
  EXPECT_NEAR(ellipse_at(m, u).slope, u / radius, 1e-6 * u / radius);
  // It curves more towards the nearer focus, here the image at positive u.
  EXPECT_GT(ellipse_at(m, 200.0).height, ellipse_at(m, -200.0).height);
}

TEST(EllipseMirror, HasNoPointBeyondItsEnd) {
  const EllipseMirror m{7500.0, 2500.0, 0.01};
  EXPECT_TRUE(std::isnan(ellipse_at(m, 2600.0).height));
  EXPECT_TRUE(std::isnan(ellipse_at(m, -7600.0).slope));
}

}  // namespace
}  // namespace dwell
