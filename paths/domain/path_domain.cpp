#include "paths/domain/path_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/numbers.h"

namespace dwell {
namespace {

Box box_of_pixels(const HeightMap& map, const char* planner) {
  Box box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (const Index i : finite_pixels(map)) {
    const Point p = map.grid.centre(i);
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  if (!(box.low.x <= box.high.x)) {
    throw InputError(fmt::format("{}: the map has no finite pixel; at least one is required", planner));
  }
  return box;
}

}  // namespace

PathDomain::PathDomain(const HeightMap& map, double reach, const char* planner, const char* option,
                       const Progress& progress)
    : reach_(checked(reach, planner, option)),
      padded_(reach + 1e-9 * std::min(map.grid.pitch_x, map.grid.pitch_y)),
      box_(box_of_pixels(map, planner)),
      distance_(map, padded_, progress) {}

DomainView PathDomain::look(Point p) const {
  const DistanceMap::Bounds b = distance_.bounds(p);
  if (b.high <= padded_) return {true, padded_ - b.high};
  if (b.low > padded_) return {false, b.low - padded_};
  return {contains(p), 0.0};
}

double PathDomain::checked(double reach, const char* planner, const char* option) {
  if (std::isfinite(reach) && reach >= 0.0) return reach;
  throw InputError(fmt::format("{}: {} = {} mm; required finite and >= 0", planner, option, reach));
}

}  // namespace dwell
