#pragma once

#include "core/map/height_map.h"

namespace dwell {

/// The part of the map whose pixel centres lie in the closed rectangle from `low` to `high` [mm]; heights and places of
/// the pixels are unchanged. Throws InputError if that holds no finite pixel, saying where the map lies.
HeightMap crop(const HeightMap& map, Point low, Point high);

/// The middle of the rectangle that holds the centres of all finite pixels [mm]; of a map without any, not finite.
Point middle_of_data(const HeightMap& map);

/// The smallest part of the map that holds all its finite pixels. Throws InputError if there are none.
HeightMap crop_to_data(const HeightMap& map);

}  // namespace dwell
