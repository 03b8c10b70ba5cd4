#include "core/profile/ellipse_mirror.h"

#include <cmath>
#include <limits>

namespace dwell {

EllipsePoint ellipse_at(const EllipseMirror& mirror, double u) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const double p = mirror.entrance_arm, q = mirror.exit_arm;
  const double s = std::sin(mirror.grazing), c = std::cos(mirror.grazing);
  const double e = s * (p - q) / (p + q), a = 1.0 - e * e;
  const double b = 2.0 * p * q * s / (p + q) - e * c * u;
  const double discriminant = b * b - a * s * s * u * u;
  if (!(discriminant > 0.0) || !(b > 0.0)) return {kNan, kNan};
  const double r = std::sqrt(discriminant);
  const double height = s * s * u * u / (b + r);
  return {height, (s * s * u + e * c * height) / r};
}

}  // namespace dwell
