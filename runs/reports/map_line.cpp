#include "runs/reports/map_line.h"

#include <fmt/format.h>

#include "core/base/counted.h"
#include "core/base/pitch.h"

namespace dwell {

std::string map_line(const Grid& grid, Index pixels) {
  return fmt::format("map       {} rows x {} columns of {}, {} in the aperture\n", grid.rows, grid.cols,
                     pitch_text(grid), counted(pixels, "pixel"));
}

}  // namespace dwell
