#pragma once

#include <limits>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/tif/removal_function.h"

namespace dwell {

/// What a path is planned for. Refers to what it was made of.
struct PathJob {
  const HeightMap& target;                                    // removal wanted [nm], NaN = outside
  const RemovalFunction& tif;                                 // its radius is the default overrun
  double max_feed = std::numeric_limits<double>::infinity();  // [mm/s]
  /// Whether notes say what has to be worked out besides the path: the feed by depth of a multi-pitch raster, which
  /// takes as long as planning it.
  bool estimates = false;
  /// Asked at least four times a second; a planner that is told to stop throws Interrupted.
  Progress progress{};
};

}  // namespace dwell
