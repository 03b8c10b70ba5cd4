#pragma once

#include "core/map/height_map.h"

namespace dwell {

/// RMS slopes over neighbouring valid pixels [urad = nm/mm].
struct SlopeStatistics {
  double x = 0.0;      // RMS of (z(x + hx, y) - z(x, y)) / hx over all pairs both valid; NaN without any
  double y = 0.0;      // likewise along y
  double total = 0.0;  // sqrt(x^2 + y^2), or the one that has pairs: of a line, its own; NaN without any
  Index pairs_x = 0, pairs_y = 0;
};

/// Differences over one pitch: noise of a pixel of RMS s adds sqrt(2) s / h. Cost O(pixels).
SlopeStatistics slope_statistics(const HeightMap& map, int threads = 1);

}  // namespace dwell
