#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

#include "core/base/grid.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// What the machine can run. Speeds in mm/s.
struct FeedLimits {
  double min_dwell = 0.0;                                     // shortest time on a stroke [s]; finite, >= 0
  double max_feed = std::numeric_limits<double>::infinity();  // fastest feed [mm/s]; > 0, infinity = no limit
};

/// The lower bound on dwell that keeps the limits: max(min_dwell, stroke length / max_feed) [s], one a stroke. Throws
/// InputError naming a limit that is out of range, its value and what is required.
Eigen::VectorXd minimum_dwell(const std::vector<Stroke>& strokes, const FeedLimits& limits);

/// The speeds that result from given dwell times.
struct FeedSchedule {
  std::vector<double> speed;      // stroke length / dwell [mm/s], one a stroke; 0 for a halt (a stroke of no length)
  double min_speed = 0.0;         // over the strokes that have a length; 0 if none has
  double max_speed = 0.0;         // infinite if one of them has no dwell time
  Index segments_limited = 0;     // dwell equal to its positive lower bound, to 1e-9 of it
  Index segments_infeasible = 0;  // dwell below its lower bound by more than that, or a length to cover in no time
};

/// The speeds follow from the dwell times, even where the machine cannot run them. dwell [s], one a stroke, finite and
/// >= 0. Throws InputError naming the first stroke (1-based) whose dwell is not, or the two sizes if they differ. Cost
/// O(strokes).
FeedSchedule feed_schedule(const std::vector<Stroke>& strokes, const Eigen::VectorXd& dwell, const FeedLimits& limits);

}  // namespace dwell
