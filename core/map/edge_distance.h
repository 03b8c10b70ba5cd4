#pragma once

#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// Distance from the centre of every pixel to that of the nearest one without data [mm], row-major; the map is
/// surrounded by such. 0 where there is no data. Cost O(pixels).
std::vector<double> edge_distances(const HeightMap& map, int threads = 1);

}  // namespace dwell
