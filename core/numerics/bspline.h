#pragma once

#include <array>

namespace dwell {

/// The four cubic B-splines that are not zero at u = floor(u) + f: B3(u - k) for k = floor(u) - 1 .. floor(u) + 2,
/// where B3 has support (-2, 2) and sums to one over k. 0 <= f < 1.
inline std::array<double, 4> bspline_weights(double f) {
  const double g = 1.0 - f;
  const double f2 = f * f, g2 = g * g;
  return {g2 * g / 6.0, (4.0 - 3.0 * f2 * (2.0 - f)) / 6.0, (4.0 - 3.0 * g2 * (2.0 - g)) / 6.0, f2 * f / 6.0};
}

/// Their derivatives by u.
inline std::array<double, 4> bspline_slopes(double f) {
  const double g = 1.0 - f;
  return {-0.5 * g * g, f * (1.5 * f - 2.0), g * (2.0 - 1.5 * g), 0.5 * f * f};
}

}  // namespace dwell
