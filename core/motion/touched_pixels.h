#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/grid.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// Pixels [first_row, last_row] x [first_col, last_col]; it is empty if a first exceeds its last.
struct PixelRange {
  Index first_row, last_row, first_col, last_col;
};

/// The pixels of a map that a tool may reach from somewhere in the bounding box of a stroke. The tool reaches the
/// displacements [low, high] from its axis [mm]. Cost O(1).
inline PixelRange touched_pixels(const Grid& map, const Stroke& stroke, Point low, Point high) {
  const auto range = [](double from, double to, double origin, double pitch, Index n) {
    const double first = std::clamp(std::ceil((from - origin) / pitch), 0.0, static_cast<double>(n));
    const double last = std::clamp(std::floor((to - origin) / pitch), -1.0, static_cast<double>(n - 1));
    return std::pair{static_cast<Index>(first), static_cast<Index>(last)};
  };
  const auto [x_low, x_high] = std::minmax({stroke.start.x, stroke.via.x, stroke.finish.x});
  const auto [y_low, y_high] = std::minmax({stroke.start.y, stroke.via.y, stroke.finish.y});
  const auto [col0, col1] = range(x_low + low.x, x_high + high.x, map.origin.x, map.pitch_x, map.cols);
  const auto [row0, row1] = range(y_low + low.y, y_high + high.y, map.origin.y, map.pitch_y, map.rows);
  return {row0, row1, col0, col1};
}

}  // namespace dwell
