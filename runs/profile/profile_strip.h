#pragma once

#include "core/map/height_map.h"
#include "runs/profile/profile_input.h"

namespace dwell {

/// The rest of a profile as a map that a plan can correct: its heights in every row of a strip about y = 0, `width_mm`
/// wide, or in one row of pixels (0). Pixels are squares of the median distance of places; heights are those of the
/// places where these lie evenly, else of the cubic spline through them. Throws InputError if the width is no multiple
/// of a pixel's to 1 % of it, or for more pixels than the limit. Cost O(pixels).
HeightMap profile_strip(const ProfileInput& profile, double width_mm);

}  // namespace dwell
