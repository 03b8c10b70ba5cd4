#include "runs/reports/map_line.h"

#include <fmt/format.h>

#include "core/base/pitch.h"

namespace dwell {

std::string map_line(const Grid& grid, Index pixels) {
  return fmt::format("map       {} rows x {} columns of {}, {} pixels in the aperture\n", grid.rows, grid.cols,
                     pitch_text(grid), pixels);
}

}  // namespace dwell
