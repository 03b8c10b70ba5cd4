#pragma once

#include <cstddef>

#include "core/base/point.h"

namespace dwell {

using Index = std::ptrdiff_t;

/// A regular rectangular grid of pixels. Rows run along y (row 0 = smallest y), columns along x (column 0 =
/// smallest x); `origin` is the centre of pixel (0, 0) [mm]; pitches are positive [mm].
struct Grid {
  Index rows = 0;
  Index cols = 0;
  double pitch_x = 1.0;
  double pitch_y = 1.0;
  Point origin;

  Index size() const { return rows * cols; }
  Index index(Index row, Index col) const { return row * cols + col; }
  double x(Index col) const { return origin.x + pitch_x * static_cast<double>(col); }
  double y(Index row) const { return origin.y + pitch_y * static_cast<double>(row); }
  Point centre(Index row, Index col) const { return {x(col), y(row)}; }
  Point centre(Index linear) const { return centre(linear / cols, linear % cols); }

  /// Extent of the pixels (outer edges), not of their centres [mm].
  double width() const { return pitch_x * static_cast<double>(cols); }
  double height() const { return pitch_y * static_cast<double>(rows); }

  friend bool operator==(const Grid&, const Grid&) = default;
};

}  // namespace dwell
