#pragma once

#include <optional>

#include "core/map/height_map.h"

namespace dwell {

/// What can be done to a part without interpolation, seen with +x right and +y up.
enum class GridTurn {
  FlipX,          // x -> -x: left and right change places
  FlipY,          // y -> -y: bottom and top change places
  Quarter,        // by 90 degrees counter-clockwise: (x, y) -> (-y, x)
  Half,           // by 180 degrees: (x, y) -> (-x, -y)
  ThreeQuarters,  // by 270 degrees counter-clockwise: (x, y) -> (y, -x)
  Transpose,      // (x, y) -> (y, x)
};

/// Where a point of the part comes to lie, with x and y counted from `about`.
Point turn_point(Point p, GridTurn turn, Point about);

/// The map with the part turned about a point [mm]; by default about the middle of the map's pixel centres, so that the
/// map stays where it is. Every height comes to lie where turn_point says, unchanged to the last bit, and so does
/// NaN. Quarter turns and transpose exchange rows and columns, and the two pitches. Cost O(pixels).
HeightMap turn_map(const HeightMap& map, GridTurn turn, std::optional<Point> about = std::nullopt);

}  // namespace dwell
