#pragma once

#include <functional>

#include "core/tif/removal_function.h"

namespace dwell {

/// The rate [nm/s] at a displacement from the tool axis, as a mean over the area of a pixel of hx by hy [mm] about it:
/// what a camera measures of a removal. Of the formulas, cut off at their radius, by closed integrals along x and
/// Gauss-Legendre across (1e-5 of the peak at a rim, rounding elsewhere); of samples, the exact integral of the spline
/// through them. Cost O(1) a call; of samples O(samples under a pixel + 25). The function keeps
/// what it needs; two threads must not call the same one.
std::function<double(Point)> mean_rate_over_pixel(const RemovalFunction& tif, double hx, double hy);

/// The rate [nm/s] at a displacement from the tool axis: the formula, zero beyond its radius, or the spline through the
/// samples. The function keeps what it needs.
std::function<double(Point)> rate_at_point(const RemovalFunction& tif);

}  // namespace dwell
