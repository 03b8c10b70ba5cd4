#pragma once

#include <vector>

#include "core/tif/calibration/spot_patch.h"

namespace dwell {

/// How several spots are aligned with each other: by their centroids, or by the shift with the least squared difference
/// from their mean.
enum class SpotRegistration { Centroid, LeastSquares };

/// Refines the centres of the patches, which must be near the truth to a third of the spot's width. The first keeps its
/// place as the reference; shifts are found to a small part of a pixel (1e-4 without noise). Method: Gauss-Newton on
/// the splines of smoothed copies of the patches within `radius`, three rounds against the mean of all. The spots
/// themselves stay as they are. Cost: about 30 spline evaluations a pixel and spot.
void register_spots(std::vector<SpotPatch>& patches, double radius, SpotRegistration how);

/// The mean of the registered patches, sampled on the pixels of the first one, and its scatter.
struct SpotMean {
  HeightMap mean;       // [nm]; on the first patch's pixels, origin relative to its centre
  HeightMap deviation;  // standard deviation over the spots, n - 1 in the denominator [nm]; zero for one spot
};

SpotMean average_spots(const std::vector<SpotPatch>& patches);

}  // namespace dwell
