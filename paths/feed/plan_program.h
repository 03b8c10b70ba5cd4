#pragma once

#include <cstddef>
#include <vector>

#include "core/motion/motion.h"
#include "core/motion/program.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// The strokes of a path under a motion: moving_strokes or halting_strokes.
std::vector<Stroke> strokes_of(const ToolPath& path, Motion motion);

/// The time [s] that the machine takes for a stroke of `length` [mm] that should take `dwell` [s]: the dwell, or length
/// / max_feed [mm/s] where rounding put the dwell below that. `point` is the 1-based number for messages. Throws
/// InputError if the dwell is not finite, if it is negative, or if it is below the limit by more than the rounding of
/// coordinates to 1e-6 mm explains: dwell max_feed < length (1 - 1e-6) - 4e-6 mm.
double dwell_within_feed(std::size_t point, double length, double dwell, double max_feed_mm_per_s);

/// The steps that the machine runs for a path with dwell times [s], one per point. Moving: two straight steps per
/// stroke, start -> via -> finish, at one speed; one step where via lies within 2e-6 mm of the segment start -> finish
/// (a straight stroke whose coordinates were rounded to 1e-6 mm does so, and so does a stroke with an empty half); a
/// halt where the stroke has no length. Stop: a halt at each point, and between points a straight step at maximum feed
/// that removes. Both motions: a lifted step (removes = false, seconds = 0) where the path is cut; the program begins
/// at the first point. Halts of 0 s are left out. Consecutive steps are chained exactly. Cost O(points). Throws
/// InputError as validate(path) and dwell_within_feed do, or unless there is a dwell for each point and max_feed is
/// finite and > 0.
Program program_of(const ToolPath& path, const std::vector<double>& dwell_s, Motion motion, double max_feed_mm_per_s);

}  // namespace dwell
