#include "core/base/grid_limit.h"

#include <fmt/format.h>

#include "core/base/errors.h"
#include "core/base/memory.h"

namespace dwell {

void check_pixels(double rows, double cols, const PixelLimit& limit, const std::string& what) {
  if (rows >= 1.0 && cols >= 1.0 && rows * cols <= limit.most()) return;
  throw InputError(fmt::format(
      "{}: a map of {:.0f} x {:.0f} pixels; from 1 to {:.0f} pixels are accepted (`max pixels` sets another "
      "limit)",
      what, rows, cols, limit.most()));
}

Grid limited_grid(double rows, double cols, Point pitch, Point origin, const std::string& what,
                  const PixelLimit& limit) {
  check_pixels(rows, cols, limit, what);
  require_memory(sizeof(double) * rows * cols, fmt::format("{}: a map of {:.0f} x {:.0f} pixels", what, rows, cols));
  return {static_cast<Index>(rows), static_cast<Index>(cols), pitch.x, pitch.y, origin};
}

Point middle_of(const Grid& grid) { return midpoint(grid.centre(0, 0), grid.centre(grid.rows - 1, grid.cols - 1)); }

}  // namespace dwell
