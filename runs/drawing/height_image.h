#pragma once

#include <string>

#include "core/map/height_map.h"

namespace dwell {

/// A 16-bit grey PNG file whose levels are heights, for programs that read images: one pixel a pixel of the map, +x
/// right, +y up (the first row of the image has the largest y).
///
///   height [nm] = offset_nm + nm_per_level * level,  level 1 to 65535;  level 0 = no data
///
/// The levels span the finite heights, so each is rounded by at most nm_per_level / 2. Text chunks (tEXt) say the rest:
/// offset_nm, nm_per_level, no_data_level, pitch_mm, origin_mm (centre of the map's first pixel, which is the lower
/// left one of the image), unit, and (iTXt) made, a chunk a step of the history. pHYs has the pitches in whole pixels
/// per metre, where the format can hold these numbers. The same map gives the same bytes. Throws InputError for a map
/// without a finite height, with an infinite one, a span beyond a double, or more than 2^31 - 1 rows or columns. Cost
/// O(pixels).
std::string height_image_png(const HeightMap& map);

}  // namespace dwell
