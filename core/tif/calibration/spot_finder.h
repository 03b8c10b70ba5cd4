#pragma once

#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// A spot as found in a map of removed depth.
struct FoundSpot {
  Point centre;         // centroid of what is deeper than 30 % of the deepest [mm]
  double extent = 0.0;  // the farthest of these pixels from the centroid [mm]
};

/// Spots in a map of removed depth [nm, positive where the surface went down]: connected regions deeper than 30 % of
/// the deepest place and than 4 scatters of the surroundings, of the map less its robust plane, smoothed over 3 x 3
/// pixels. Regions closer to each other than their extents are one spot (a ring, two lobes); those of less than a tenth
/// of the largest volume are dropped. Largest y first, then smallest x. The surroundings must be more than half of the
/// map. Throws InputError if nothing stands out, or if more stands out upwards than down (before and after swapped).
/// Cost O(pixels).
std::vector<FoundSpot> find_spots(const HeightMap& depth);

/// Throws InputError because the surface rises where it should have gone down; the message says how to mend that.
[[noreturn]] void refuse_rise(double rise, double fall);

}  // namespace dwell
