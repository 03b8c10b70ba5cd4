#include "core/map/part_distance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"

namespace dwell {

double farthest_from_part(const Grid& map, double tool_radius) {
  constexpr double kMetre = 1000.0;
  constexpr double kDiagonals = 10.0;
  return std::max(kMetre, kDiagonals * (std::hypot(map.width(), map.height()) + 2.0 * tool_radius));
}

double distance_from_map(const Grid& map, Point p) {
  const auto beyond = [](double at, double low, double high) { return std::max({low - at, at - high, 0.0}); };
  return std::hypot(beyond(p.x, map.x(0), map.x(map.cols - 1)), beyond(p.y, map.y(0), map.y(map.rows - 1)));
}

void check_near_part(Point p, const Grid& map, double tool_radius, const std::function<std::string()>& name) {
  const double farthest = farthest_from_part(map, tool_radius), away = distance_from_map(map, p);
  if (away <= farthest) return;
  throw InputError(fmt::format(
      "{} = ({:.6g}, {:.6g}) mm is {:.6g} mm from the map, which has x {:.6g} to {:.6g} and y {:.6g} to {:.6g} mm; "
      "required within {:.6g} mm of it, in the map's coordinates and in mm",
      name(), p.x, p.y, away, map.x(0), map.x(map.cols - 1), map.y(0), map.y(map.rows - 1), farthest));
}

}  // namespace dwell
