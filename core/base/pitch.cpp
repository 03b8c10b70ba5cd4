#include "core/base/pitch.h"

#include <fmt/format.h>

namespace dwell {

std::string pitch_text(const Grid& grid) {
  if (grid.pitch_x == grid.pitch_y) return fmt::format("{:.6g} mm", grid.pitch_x);
  return fmt::format("{:.6g} x {:.6g} mm", grid.pitch_x, grid.pitch_y);
}

std::string pitch_option_text(const Point& pitch) {
  return pitch.x == pitch.y ? fmt::format("{}", pitch.x) : fmt::format("{},{}", pitch.x, pitch.y);
}

}  // namespace dwell
