#pragma once

#include <string>

#include "core/map/height_map.h"

namespace dwell {

/// 10 mm, 10 mm/s [nm, nm/s]: what spans more is in another unit, or holds numbers that are no heights.
inline constexpr double kMostSpan = 1e7;

/// Throws InputError unless one value of the map at least is finite and all span `most` at most. `name` is "map" or
/// "tif" (the options to name); `where` begins the message. Cost O(pixels).
void check_value_span(const HeightMap& map, double most, const std::string& name, const std::string& where);

}  // namespace dwell
