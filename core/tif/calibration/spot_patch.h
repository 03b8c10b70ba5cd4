#pragma once

#include <vector>

#include "core/map/height_map.h"
#include "core/numerics/spline_surface.h"

namespace dwell {

/// One spot, cut out of a map of removed depth with its surroundings' plane taken off.
struct SpotPatch {
  Point centre;              // as registered [mm in the map]
  HeightMap depth;           // [nm] on the map's own pixels about it; no data: filled from neighbours
  std::vector<char> filled;  // one a pixel: it had no data
  SplineSurface surface;     // through `depth`
  double scatter = 0.0;      // of the surroundings [nm]
  Index filled_inside = 0;   // pixels within the radius that had no data
};

/// How the level of the surroundings is taken off: a plane or a constant through the ring from 1 to 1.6 radii about the
/// spot (without other spots), or nothing.
enum class SpotBaseline { Plane, Constant, None };

/// Cuts out the spot near `centre`. `others`: centres of all spots, this one among them. Throws InputError if more than
/// 5 % of the pixels within `radius` have no data or lie off the map, if there are fewer than 12 such pixels, or if the
/// surroundings are too few or on one side only.
SpotPatch cut_spot(const HeightMap& depth, Point centre, double radius, const std::vector<Point>& others,
                   SpotBaseline baseline);

/// The centroid, in the coordinates of the map, of a patch's values above `share` of its largest, less that level, so
/// that lower noise does not count. Only values within `radius` of the centroid itself count, which is found by
/// iteration from `start`.
Point spot_centroid(const SpotPatch& patch, Point start, double radius, double share);

}  // namespace dwell
