#pragma once

#include <cstddef>
#include <vector>

#include "core/motion/motion.h"
#include "core/motion/program.h"
#include "core/motion/tool_path.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// The time [s] that the machine takes for a stroke of `length` [mm] that should take `dwell` [s]: the dwell, or length
/// / max_feed [mm/s] where rounding put the dwell below that. `point` is the 1-based number for messages. Throws
/// InputError if the dwell is not finite, if it is negative, or if it is below the limit by more than the rounding of
/// coordinates to 1e-6 mm explains: dwell max_feed < length (1 - 1e-6) - 4e-6 mm.
double dwell_within_feed(std::size_t point, double length, double dwell, double max_feed_mm_per_s);

/// The steps that the machine runs for a path with dwell times [s], one per point: those of stroke_moves, a stroke at
/// one speed, moves between stops at maximum feed, lifted ones with seconds = 0. The program begins at the first point;
/// halts of 0 s are left out. Cost O(points). Throws
/// InputError as validate(path) and dwell_within_feed do, or unless there is a dwell for each point and max_feed is
/// finite and > 0.
Program program_of(const ToolPath& path, const std::vector<double>& dwell_s, Motion motion, double max_feed_mm_per_s);

}  // namespace dwell
