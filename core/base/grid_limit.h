#pragma once

#include <optional>
#include <string>

#include "core/base/grid.h"

namespace dwell {

/// The most pixels of a map that is read or made, unless the user says otherwise: 16384 x 16384, 2 GiB of heights.
inline constexpr double kMaxPixels = 268435456.0;

/// The one limit of every reader of maps and of every step that makes one. It is asked before memory is taken.
struct PixelLimit {
  std::optional<double> given;  // by the user (`max pixels`), from 1 to kMostPixelsOfAll

  double most() const { return given.value_or(kMaxPixels); }
};

/// The most pixels that a user may allow: indices of 32 bits in libraries end there.
inline constexpr double kMostPixelsOfAll = 2147483648.0;

/// Throws InputError that begins with `what` unless rows and cols (whole numbers, as computed) are finite and make from
/// 1 to limit.most() pixels.
void check_pixels(double rows, double cols, const PixelLimit& limit, const std::string& what);

/// A grid of rows x cols pixels, for a map to be made. Throws as check_pixels, and OutOfMemory if its values alone take
/// more than there is.
Grid limited_grid(double rows, double cols, Point pitch, Point origin, const std::string& what,
                  const PixelLimit& limit = {});

/// The middle of the pixel centres [mm].
Point middle_of(const Grid& grid);

}  // namespace dwell
