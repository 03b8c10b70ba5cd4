#pragma once

#include <string>

#include "core/base/grid.h"

namespace dwell {

/// The most pixels of a map that a step may make: 2 GiB of heights.
inline constexpr double kMaxPixels = 268435456.0;

/// A grid of rows x cols pixels (whole numbers, as computed). Throws InputError that begins with `what` if there are
/// fewer than 1 or more than kMaxPixels of them, or a number is not finite.
Grid limited_grid(double rows, double cols, Point pitch, Point origin, const std::string& what);

/// The middle of the pixel centres [mm].
Point middle_of(const Grid& grid);

}  // namespace dwell
