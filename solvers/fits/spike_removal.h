#pragma once

#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

inline constexpr double kSpikeSigmas = 5.0;
inline constexpr Index kSpikeWindow = 5;
inline constexpr double kLeastSpike = 0.2;  // quantised heights differ by steps from an even neighbourhood

/// The map without its lone spikes (register_maps says which they are), and how many these were. A spline through a map
/// rings around each spike, so a fit would see a pattern that stays with the pixels instead of the surface. Throws
/// Interrupted. Cost O(pixels).
std::pair<HeightMap, Index> without_spikes(HeightMap map, int threads, const Progress& progress);

/// Robust standard deviation of residuals about zero: 1.4826 times the median of their sizes.
double robust_sigma(std::vector<double> residuals);

}  // namespace dwell
