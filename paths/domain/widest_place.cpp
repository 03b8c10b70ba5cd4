#include "paths/domain/widest_place.h"

#include <cmath>

#include "core/base/errors.h"
#include "paths/domain/distance_map.h"

namespace dwell {

WidestPlace widest_place(const HeightMap& map, const Progress& progress) {
  Grid framed = map.grid;
  framed.rows += 2;
  framed.cols += 2;
  framed.origin = map.grid.origin - Point{map.grid.pitch_x, map.grid.pitch_y};
  HeightMap missing(framed, std::vector<double>(static_cast<std::size_t>(framed.size()), 0.0));
  bool any = false;
  for (const Index i : finite_pixels(map)) {
    missing.at(i / map.grid.cols + 1, i % map.grid.cols + 1) = std::nan("");
    any = true;
  }
  if (!any) throw InputError("widest place: the map has no finite pixel; at least one is required");
  const DistanceMap distance(missing, 0.0, progress);
  WidestPlace place;
  for (const Index i : finite_pixels(map)) {
    const double room = distance.at_node(i / map.grid.cols + 1, i % map.grid.cols + 1);
    if (room > place.radius * (1.0 + 1e-9)) place = {map.grid.centre(i), room};
  }
  return place;
}

}  // namespace dwell
