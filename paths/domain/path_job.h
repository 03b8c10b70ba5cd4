#pragma once

#include <limits>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/tif/removal_function.h"

namespace dwell {

/// What a path is planned for. It refers to the map and the removal function, which must outlive it.
struct PathJob {
  const HeightMap& target;                                    // removal wanted [nm], NaN = outside
  const RemovalFunction& tif;                                 // its radius is the default overrun
  double max_feed = std::numeric_limits<double>::infinity();  // [mm/s]
  /// Whether notes shall hold what needs a computation of its own: the feed by depth of a multi-pitch raster, which
  /// takes as long as planning it.
  bool estimates = false;
  /// Asked at least four times a second; where it says stop, the planner throws Interrupted.
  Progress progress{};
};

}  // namespace dwell
