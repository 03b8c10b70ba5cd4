#include "core/base/grid_limit.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace dwell {

Grid limited_grid(double rows, double cols, Point pitch, Point origin, const std::string& what) {
  if (!(rows >= 1.0 && cols >= 1.0 && rows * cols <= kMaxPixels)) {
    throw InputError(
        fmt::format("{}: a map of {} x {} pixels; from 1 to {} pixels are accepted", what, rows, cols, kMaxPixels));
  }
  return {static_cast<Index>(rows), static_cast<Index>(cols), pitch.x, pitch.y, origin};
}

Point middle_of(const Grid& grid) { return midpoint(grid.centre(0, 0), grid.centre(grid.rows - 1, grid.cols - 1)); }

}  // namespace dwell
