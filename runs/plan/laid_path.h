#pragma once

#include <vector>

#include "core/motion/motion.h"
#include "core/motion/tool_path.h"
#include "paths/metrics/path_metrics.h"
#include "paths/path_catalogue.h"
#include "runs/plan/part.h"

namespace dwell {

/// A path as it lies on the part, and how the machine runs it. Second of the four values of a plan.
struct LaidPath {
  ToolPath path;  // coordinates rounded to what the feed table holds, so that what is solved is what is exported
  Motion motion = Motion::Moving;
  std::vector<Stroke> strokes;  // one a dwell point
  PathMetrics metrics;
};

/// Lays a path that is given. Throws InputError as validate(path).
LaidPath lay_path(ToolPath path, Motion motion);

/// Plans a path on the part and lays it; planners that estimate times use `max_feed` [mm/s]. Throws InputError as
/// plan_path, Interrupted. Cost: the planner's.
LaidPath lay_path(const Part& part, const PathSpec& spec, Motion motion, double max_feed,
                  const Progress& progress = {});

}  // namespace dwell
