#pragma once

#include <cmath>
#include <limits>

#include "core/map/height_map.h"

namespace dwell::test {

inline constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();

/// A map without any symmetry: unequal sides and pitches, an origin off zero, holes inside and at the edge.
inline HeightMap uneven_map(Index rows = 9, Index cols = 14) {
  HeightMap map(Grid{rows, cols, 0.3, 0.2, {-1.1, 2.3}});
  for (Index r = 0; r < rows; ++r) {
    for (Index c = 0; c < cols; ++c) {
      const double x = 0.3 * static_cast<double>(c), y = 0.2 * static_cast<double>(r);
      const bool hole = (r == 3 && c >= 5 && c <= 7) || (r == 4 && c == 6) || (r <= 1 && c >= cols - 3);
      map.at(r, c) = hole ? kNoData : 10.0 * std::sin(1.3 * x) * std::cos(0.9 * y + 0.4) + 2.0 * x - y * y;
    }
  }
  map.history = {"measured"};
  return map;
}

/// A map of a function of x and y [mm].
template <class Height>
HeightMap map_of(const Grid& grid, const Height& height) {
  HeightMap map(grid);
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = height(p.x, p.y);
  }
  return map;
}

}  // namespace dwell::test
