#pragma once

namespace dwell {

/// Integrals of radial removal functions along a straight line, at a distance from the axis. `width` is u1 - u0, which
/// callers know better than the rounded difference. O(1).

/// Of the distance sqrt(u^2 + d^2) over u0 < u < u1. From the antiderivative (u r + d^2 asinh(u / d)) / 2, rearranged
/// so that no term cancels however close u0 and u1 are.
double integral_of_distance(double d, double u0, double u1, double width);

/// Of exp(-u^2 / 2 sigma^2) over u0 < u < u1.
double integral_of_gaussian(double sigma, double u0, double u1, double width);

}  // namespace dwell
