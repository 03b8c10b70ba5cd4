#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// The roomiest place of a part.
struct WidestPlace {
  Point centre;         // [mm]
  double radius = 0.0;  // of the largest disc about it without a pixel that is missing or beyond the map [mm]
};

/// The centre of the valid pixel farthest from all missing ones and from the map's rim (a frame of one more pixel
/// counts as missing); of several, equal to 1e-9, the first. Throws InputError if no pixel is finite. Cost O(pixels).
WidestPlace widest_place(const HeightMap& map, const Progress& progress = {});

}  // namespace dwell
