#pragma once

#include <functional>
#include <string>

#include "core/base/grid.h"
#include "core/base/point.h"

namespace dwell {

/// How far from the map a tool at work may be [mm]: 1 m, or ten times the diagonal of the map and the tool together if
/// that is more. A path farther off is not one of this part: its coordinates have another unit, or are a slip.
double farthest_from_part(const Grid& map, double tool_radius);

/// Distance of a point from the rectangle of the map's pixel centres [mm]; 0 within it.
double distance_from_map(const Grid& map, Point p);

/// Throws InputError naming the point, its distance, the place of the map and what is accepted, if the tool at work
/// would be farther off than farthest_from_part. `name` says whose point it is, as "path.csv: dwell point 3". Cost
/// O(1).
void check_near_part(Point p, const Grid& map, double tool_radius, const std::function<std::string()>& name);

}  // namespace dwell
