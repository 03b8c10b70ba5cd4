#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/base/errors.h"
#include "core/map/height_map.h"

namespace dwell::test {

/// A map from a picture, top row first (as one looks at the part): '.' = no data, a digit = that height.
inline HeightMap map_from_picture(const std::vector<std::string>& picture, double pitch = 1.0, Point origin = {}) {
  Grid grid;
  grid.rows = static_cast<Index>(picture.size());
  grid.cols = static_cast<Index>(picture.front().size());
  grid.pitch_x = grid.pitch_y = pitch;
  grid.origin = origin;
  HeightMap map(grid);
  for (Index row = 0; row < grid.rows; ++row) {
    const std::string& line = picture[static_cast<std::size_t>(grid.rows - 1 - row)];
    for (Index col = 0; col < grid.cols; ++col) {
      const char c = line[static_cast<std::size_t>(col)];
      if (c != '.') map.at(row, col) = c - '0';
    }
  }
  return map;
}

/// A full map of constant height.
inline HeightMap full_map(Index rows, Index cols, double pitch_x = 1.0, double pitch_y = 1.0, Point origin = {}) {
  const Grid grid{rows, cols, pitch_x, pitch_y, origin};
  return HeightMap(grid, std::vector<double>(static_cast<std::size_t>(grid.size()), 1.0));
}

/// Distance from a point to the nearest valid pixel centre, by looking at all of them.
inline double brute_force_distance(const HeightMap& map, Point p) {
  double best = std::numeric_limits<double>::infinity();
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      best = std::min(best, std::hypot(p.x - map.grid.x(col), p.y - map.grid.y(row)));
    }
  }
  return best;
}

/// Message of the InputError that the action throws; empty if it throws none.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

}  // namespace dwell::test
