#pragma once

#include <vector>

namespace dwell {

/// A radial profile b(r) at r = 0, step, 2 step, ...; linear between, zero beyond the last.
struct RadialProfile {
  double step = 0.0;
  std::vector<double> values;
  double smoothing = 0.0;  // weight of the second differences that was chosen
  double misfit = 0.0;     // RMS of what the profile leaves of the line integrals, weighted like them

  double operator()(double r) const;
};

/// A line integral of a rotationally symmetric function along a line at distance |offset| from its axis.
struct LineIntegral {
  double offset = 0.0;
  double value = 0.0;
  double weight = 1.0;  // 1 / variance, to any scale
};

/// Finds the function b of the radius whose Abel transform, 2 integral from |offset| of b(r) r / sqrt(r^2 - offset^2)
/// dr, fits the line integrals. b is a sum of hat functions on `count` steps up to `radius`, whose transforms are known
/// in closed form. The fit is by least squares with a weight on the second differences of b (even about r = 0), which
/// generalised cross-validation chooses (Golub, Heath, Wahba 1979) among 40 values from 1e-8 to 1e4 of the mean
/// diagonal. Unlike the inverse formula, this needs no derivative of the data. count >= 4, radius > 0, at least four
/// integrals within the radius. Throws std::invalid_argument. Cost O(40 count^3).
RadialProfile abel_inversion(const std::vector<LineIntegral>& integrals, double radius, int count);

}  // namespace dwell
