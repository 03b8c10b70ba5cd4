#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// The roomiest place of a part.
struct WidestPlace {
  Point centre;         // [mm]
  double radius = 0.0;  // of the largest disc about it without a missing pixel, or one beyond the map [mm]
};

/// The centre of the valid pixel that is farthest from all missing ones, where a frame of one pixel around the map
/// counts as missing; the first of several that are equal to 1e-9. Throws InputError if no pixel is finite. Cost
/// O(pixels).
WidestPlace widest_place(const HeightMap& map, const Progress& progress = {});

}  // namespace dwell
