#include "core/formats/part_size.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"

namespace dwell {
namespace {

constexpr double kLargestPart = 20e3;    // mm: twice the largest mirror in one piece
constexpr double kSmallestPitch = 1e-7;  // mm: less than an atom

}  // namespace

void check_part_size(const Grid& grid, const std::string& field, const std::string& where) {
  const double smallest = std::min(grid.pitch_x, grid.pitch_y), largest = std::max(grid.width(), grid.height());
  if (smallest >= kSmallestPitch && largest <= kLargestPart) return;
  throw InputError(
      fmt::format("{}: {} makes a part of {:.6g} x {:.6g} mm out of {} x {} pixels of {:.6g} x {:.6g} mm; a pitch of "
                  "at least {} mm "
                  "and a part of at most {} mm are accepted: is its unit right?",
                  where, field, grid.width(), grid.height(), grid.cols, grid.rows, grid.pitch_x, grid.pitch_y,
                  kSmallestPitch, kLargestPart));
}

}  // namespace dwell
