#pragma once

#include <algorithm>
#include <memory>
#include <optional>

#include "core/base/units.h"
#include "paths/feed/feed.h"
#include "paths/feed/machine.h"
#include "runs/plan/learnt_motion.h"

namespace dwell {

/// What the machine can run, in the units of its manual.
struct MachineLimits {
  double min_dwell_s = 0.0;                      // shortest time at a dwell point [s]; >= 0
  double max_feed_mm_per_min = 3000.0;           // fastest feed; > 0, finite
  std::optional<Machine> machine{};              // nothing: accelerations and corners are not considered
  std::shared_ptr<const LearntMotion> learnt{};  // of the path from logs of its runs; null: nothing

  /// The same in the units of the solvers. The machine's own fastest feed counts as well.
  FeedLimits feed_limits() const {
    const double max_feed = units::mm_per_s(max_feed_mm_per_min);
    return {min_dwell_s, machine ? std::min(max_feed, machine->max_feed) : max_feed};
  }
};

}  // namespace dwell
