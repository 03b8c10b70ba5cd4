#pragma once

#include <optional>

#include "core/map/height_map.h"

namespace dwell {

/// The apex of the paraboloid through the finite values above 70 % of `peak` within `radius` [mm] of `about`, each
/// weighted by its excess over that level [mm]. Nothing where these values are fewer than nine, or their top is not
/// rounded (the pixel at the apex is below half the peak, or it curves upwards): a ring, several peaks, or noise. Cost
/// O(pixels).
std::optional<Point> rounded_apex(const HeightMap& map, double peak, Point about, double radius);

}  // namespace dwell
