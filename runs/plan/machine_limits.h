#pragma once

#include "core/base/units.h"
#include "paths/feed/feed.h"

namespace dwell {

/// What the machine can run, in the units of its manual.
struct MachineLimits {
  double min_dwell_s = 0.0;             // shortest time at a dwell point [s]; >= 0
  double max_feed_mm_per_min = 3000.0;  // fastest feed; > 0, finite

  /// The same in the units of the solvers.
  FeedLimits feed_limits() const { return {min_dwell_s, units::mm_per_s(max_feed_mm_per_min)}; }
};

}  // namespace dwell
