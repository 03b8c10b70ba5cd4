#pragma once

#include "core/grid.h"
#include "core/tool_path.h"

namespace dwell {

/// Lengths are in mm.
struct PathMetrics {
  Index points = 0;
  double length = 0.0;         // of the strokes of a moving tool: where it removes (N g for N points of spacing g)
  double point_length = 0.0;   // from dwell point to dwell point, all moves, lifted or not ((N - 1) g); Xie et al. 2022
  double lifted_length = 0.0;  // the part of point_length that is lifted
  double longest_jump = 0.0;   // largest distance between consecutive dwell points, lifted or not
  Index lifts = 0;             // lifted moves between dwell points; the arrival at the first is not counted
};

/// Throws InputError if the path is not valid. Cost O(points).
PathMetrics path_metrics(const ToolPath& path);

}  // namespace dwell
