#include "core/tool_path.h"

#include <fmt/format.h>

#include <cmath>

#include "core/errors.h"

namespace dwell {

std::vector<Stroke> moving_strokes(const ToolPath& path) {
  const std::size_t n = path.size();
  std::vector<Stroke> strokes(n);
  for (std::size_t j = 0; j < n; ++j) {
    const Point p = path.points[j];
    const bool joined_before = j > 0 && !path.lifted[j];
    const bool joined_after = j + 1 < n && !path.lifted[j + 1];
    Stroke& s = strokes[j];
    s.via = p;
    s.start = joined_before ? midpoint(path.points[j - 1], p) : p;
    s.finish = joined_after ? midpoint(p, path.points[j + 1]) : p;
    if (joined_after && !joined_before) s.start = p - (s.finish - p);
    if (joined_before && !joined_after) s.finish = p + (p - s.start);
  }
  return strokes;
}

std::vector<Stroke> halting_strokes(const ToolPath& path) {
  std::vector<Stroke> strokes(path.size());
  for (std::size_t j = 0; j < path.size(); ++j) strokes[j] = {path.points[j], path.points[j], path.points[j]};
  return strokes;
}

void validate(const ToolPath& path) {
  if (path.points.empty()) throw InputError("tool path has no dwell points; at least one is required");
  if (path.lifted.size() != path.points.size()) {
    throw InputError(fmt::format("tool path has {} points but {} lift flags", path.points.size(), path.lifted.size()));
  }
  for (std::size_t j = 0; j < path.size(); ++j) {
    if (!std::isfinite(path.points[j].x) || !std::isfinite(path.points[j].y)) {
      throw InputError(fmt::format("tool path point {} = ({}, {}) mm; coordinates must be finite", j + 1,
                                   path.points[j].x, path.points[j].y));
    }
  }
}

}  // namespace dwell
