#pragma once

#include <vector>

#include "core/map/height_map.h"

namespace dwell {

/// How much of the map lies in the zone at the edge of the part.
struct EdgeZone {
  double width = 0.0;                // [mm]
  std::vector<unsigned char> holds;  // a pixel each: 1 if it has data and its centre lies in the zone
  Index pixels = 0;                  // in the zone
};

/// The zone at the edge of a part for a tool: pixels whose centre is at most half of the tool's FWHM from the nearest
/// place without data. There the tool's core reaches over the edge, and what it may remove depends on how far the path
/// overruns. Holes narrower than the FWHM, by the shorter side of their bounding box, are no edge, since the tool works
/// on all sides of them: lost pixels, fiducials, a masked speck. Of a map of one row or one column only its ends, and
/// what it lacks between, are edges. fwhm [mm], >= 0. Cost O(pixels).
EdgeZone edge_zone(const HeightMap& map, double fwhm, int threads = 1);

inline constexpr double kEdgeZoneInFwhm = 0.5;

}  // namespace dwell
