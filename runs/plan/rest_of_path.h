#pragma once

#include <cstddef>
#include <vector>

#include "core/motion/motion.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// The dwell points that are left of a path, each with the dwell that is left [s].
struct RestOfPath {
  ToolPath path;
  std::vector<double> dwell;
};

/// What is left of a path with its dwell, from a place within one of its strokes on. `stroke`: the index of its dwell
/// point; `done`: the share of its length (of its time, where it has none) that was run, >= 0 and < 1. `max_feed`
/// [mm/s].
///
/// A path is its dwell points, and its strokes follow from these (tool_path.h): a piece begins straight before its
/// first point. So that the strokes which are left stay what they were, the rest begins with a dwell point or two of
/// its own where it must: on the way from the place of the stop to the next dwell point, or on a straight piece to the
/// end of the stroke. Where none of these keeps the strokes, the stroke's own point has the dwell that is left of it,
/// over its whole length. Empty where nothing is left. Cost O(points).
RestOfPath rest_of_path(const ToolPath& path, const std::vector<double>& dwell, Motion motion, std::size_t stroke,
                        double done, double max_feed);

}  // namespace dwell
