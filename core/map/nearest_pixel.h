#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// For every pixel of the map the linear index of a finite pixel whose centre is nearest to it [mm, exact to rounding]:
/// itself, if it is finite. Throws InputError if no pixel is finite. Cost and memory O(pixels).
std::vector<Index> nearest_pixels(const HeightMap& map, const Progress& progress = {});

}  // namespace dwell
