#pragma once

#include "core/base/coarse_factor.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// The coarsest pixels on which the removal function is still itself: the largest factor for which the cubic spline
/// through every factor-th sample differs from the removal function by at most `tolerance` of its norm. A Gaussian of
/// sigma s allows 0.8 s for 1e-2. 1 if none is good. Cost: a few evaluations of every sample of the kernel.
CoarseFactor matched_factor(const RemovalKernel& kernel, double tolerance);

/// The kernel on pixels `factor` times coarser that takes dwell to the spline coefficients of the removal: the spline
/// through every factor-th sample, prefiltered once more. Tails below `tail` of the largest coefficient are cut off.
RemovalKernel matched_kernel(const RemovalKernel& kernel, CoarseFactor factor, double tail = 1e-5);

/// Sigma, in pixels, of the Gaussian whose volume and energy are the kernel's.
double equivalent_sigma(const RemovalKernel& kernel);

/// The pitch that is no more than `share` of equivalent_sigma, in whole pixels: about equal both ways; at least 1.
CoarseFactor coarse_factor(const RemovalKernel& kernel, double share);

/// N log2 N for the padded transform of a map with this kernel: the unit in which operators of different size compare.
double transform_cost(const Grid& map, const RemovalKernel& kernel);

/// Cost of an operator pair of the map's pixels with this kernel, in the unit of transform_cost: of CoarseRemoval,
/// mostly that of its passes over the pixels.
double operator_cost(const Grid& map, const RemovalKernel& kernel);

}  // namespace dwell
