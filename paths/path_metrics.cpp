#include "paths/path_metrics.h"

#include <algorithm>

namespace dwell {

PathMetrics path_metrics(const ToolPath& path) {
  validate(path);
  PathMetrics metrics;
  metrics.points = static_cast<Index>(path.size());
  for (const Stroke& stroke : moving_strokes(path)) metrics.length += stroke.length();
  for (std::size_t j = 1; j < path.size(); ++j) {
    const double move = distance(path.points[j - 1], path.points[j]);
    metrics.point_length += move;
    metrics.longest_jump = std::max(metrics.longest_jump, move);
    if (path.lifted[j]) {
      metrics.lifted_length += move;
      ++metrics.lifts;
    }
  }
  return metrics;
}

}  // namespace dwell
