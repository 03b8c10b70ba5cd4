#include "paths/feed/speed_change.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

/// The real root of s^3 + p s = q for p >= 0, q >= 0.
double cubic_root(double p, double q) {
  if (!(p > 0.0)) return std::cbrt(q);
  const double scale = std::sqrt(p / 3.0);
  double s = 2.0 * scale * std::sinh(std::asinh(1.5 * q / (p * scale)) / 3.0);
  for (int step = 0; step < 2; ++step) s -= (s * (s * s + p) - q) / (3.0 * s * s + p);  // what the functions round
  return s;
}

}  // namespace

double SpeedChange::seconds(double change) const {
  const double size = std::abs(change);
  if (!limits_jerk()) return size / acceleration;
  const bool ends_before = size * jerk <= acceleration * acceleration;
  return ends_before ? 2.0 * std::sqrt(size / jerk) : size / acceleration + acceleration / jerk;
}

double SpeedChange::length(double from, double to) const { return 0.5 * (from + to) * seconds(to - from); }

double SpeedChange::peak(double change) const {
  return limits_jerk() ? std::min(acceleration, std::sqrt(std::abs(change) * jerk)) : acceleration;
}

double SpeedChange::reached(double from, double length) const {
  if (!limits_jerk()) return std::sqrt(from * from + 2.0 * acceleration * length);
  // With the change d: up to a^2 / j the way is (2 from + d) sqrt(d / j), with s = sqrt(d / j) thus 2 from s + j s^3.
  const double s = cubic_root(2.0 * from / jerk, length / jerk);
  if (s * jerk <= acceleration) return from + jerk * s * s;
  // Beyond it (2 from + d) / 2 (d / a + a / j): the positive root of d^2 + (2 from + a^2 / j) d = 2 a (length - from a
  // / j).
  const double half = 0.5 * (2.0 * from + acceleration * acceleration / jerk);
  const double rest = 2.0 * acceleration * (length - from * acceleration / jerk);
  return from + rest / (half + std::sqrt(half * half + rest));
}

}  // namespace dwell
