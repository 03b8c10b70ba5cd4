#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// Mean over the valid pixels of a box about every valid pixel: the whole pixels within half of `side` [mm] of it along
/// x and along y, at least its own. NaN stays NaN; a side of less than two pitches averages nothing in that direction.
/// Throws InputError unless the side is finite and >= 0. Cost O(pixels), whatever the side.
HeightMap box_mean(const HeightMap& map, double side, const Progress& progress = {});

}  // namespace dwell
