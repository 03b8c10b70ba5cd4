#include "core/map/height_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/counted.h"
#include "core/base/errors.h"

namespace dwell {
namespace {

void check_grid(const Grid& grid) {
  if (grid.rows < 1 || grid.cols < 1) {
    throw InputError(fmt::format("map of {} x {} pixels; at least 1 x 1 required", grid.rows, grid.cols));
  }
  if (!(std::isfinite(grid.pitch_x) && grid.pitch_x > 0.0 && std::isfinite(grid.pitch_y) && grid.pitch_y > 0.0)) {
    throw InputError(fmt::format("pixel pitch = {} x {} mm; both must be finite and > 0", grid.pitch_x, grid.pitch_y));
  }
  if (!std::isfinite(grid.origin.x) || !std::isfinite(grid.origin.y)) {
    throw InputError(fmt::format("map origin = ({}, {}) mm; must be finite", grid.origin.x, grid.origin.y));
  }
}

}  // namespace

HeightMap::HeightMap(const Grid& g) : grid(g) {
  check_grid(g);
  values.assign(static_cast<std::size_t>(g.size()), std::numeric_limits<double>::quiet_NaN());
}

HeightMap::HeightMap(const Grid& g, std::vector<double> v) : grid(g), values(std::move(v)) {
  check_grid(g);
  if (static_cast<Index>(values.size()) != g.size()) {
    throw InputError(fmt::format("map has {}; its grid of {} x {} needs {}", counted(values.size(), "value"), g.rows,
                                 g.cols, g.size()));
  }
}

Index HeightMap::valid_pixels() const {
  return std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

std::vector<Index> finite_pixels(const HeightMap& map) {
  std::vector<Index> pixels;
  pixels.reserve(static_cast<std::size_t>(map.valid_pixels()));
  for (Index i = 0; i < map.grid.size(); ++i) {
    if (std::isfinite(map.values[static_cast<std::size_t>(i)])) pixels.push_back(i);
  }
  return pixels;
}

}  // namespace dwell
