#pragma once

#include <cmath>

#include "core/map/height_map.h"

namespace dwell::test {

/// A measured tool of 4 nm/s without any symmetry, on 49 x 57 samples of 0.25 x 0.2 mm about (40, -30) mm: steeper to
/// +x than to -x, narrower along y; FWHM about 2.9 mm. Its top is off the middle of the grid by `off`.
inline HeightMap measured_tool(Point off = {}, double width = 1.0) {
  HeightMap rates(Grid{49, 57, 0.25, 0.2, {40.0 - 7.0, -30.0 - 4.8}});
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const Point p = (1.0 / width) * (rates.grid.centre(i) - Point{40.0, -30.0} - off);
    const double lead = p.x > 0.0 ? 1.2 : 1.5;
    rates.values[static_cast<std::size_t>(i)] =
        4.0 * std::exp(-0.5 * (p.x * p.x / (lead * lead) + p.y * p.y / (1.1 * 1.1)));
  }
  rates.quantity = MapQuantity::Rate;
  return rates;
}

}  // namespace dwell::test
