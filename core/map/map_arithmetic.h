#pragma once

#include <string>
#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// Why two grids are not the same, in words; empty if they are: equal sizes, and no pixel centres farther apart than
/// 1e-6 of the pitch.
std::string grid_difference(const Grid& a, const Grid& b);

/// a - b, NaN where either has no data. Throws InputError if the grids differ or no pixel has data in both.
HeightMap difference(const HeightMap& a, const HeightMap& b);

/// The mean of the maps at every pixel, over those that have data there; NaN where fewer than `least` have. Throws
/// InputError if the grids differ, `least` is not from 1 to their number, or no pixel has data in so many. If the maps
/// differ in piston or tilt, the mean has a step wherever one of them has no data: level them before, or require data
/// in all.
HeightMap mean_map(const std::vector<HeightMap>& maps, Index least);

}  // namespace dwell
