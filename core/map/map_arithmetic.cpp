#include "core/map/map_arithmetic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"

namespace dwell {
namespace {

std::string describe_grid(const Grid& g) {
  return fmt::format("{} x {} pixels of {} x {} mm, the first at ({}, {}) mm", g.rows, g.cols, g.pitch_x, g.pitch_y,
                     g.origin.x, g.origin.y);
}

void require_same_grid(const HeightMap& a, const HeightMap& b) {
  const std::string why = grid_difference(a.grid, b.grid);
  if (!why.empty()) throw InputError(why);
}

}  // namespace

std::string grid_difference(const Grid& a, const Grid& b) {
  constexpr double kSame = 1e-6;
  const auto apart = [](Point p, Point q, const Grid& g) {
    return !(std::abs(p.x - q.x) <= kSame * g.pitch_x && std::abs(p.y - q.y) <= kSame * g.pitch_y);
  };
  if (a.rows == b.rows && a.cols == b.cols && !apart(a.origin, b.origin, a) &&
      !apart(a.centre(a.rows - 1, a.cols - 1), b.centre(b.rows - 1, b.cols - 1), a) &&
      !(std::abs(a.pitch_x - b.pitch_x) > kSame * a.pitch_x) &&
      !(std::abs(a.pitch_y - b.pitch_y) > kSame * a.pitch_y)) {
    return "";
  }
  return fmt::format("the maps lie on different grids, {} and {}; they must agree to 1e-6 pixels", describe_grid(a),
                     describe_grid(b));
}

HeightMap difference(const HeightMap& a, const HeightMap& b) {
  require_same_grid(a, b);
  HeightMap result = a;
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] -= b.values[i];
  if (result.valid_pixels() == 0) throw InputError("no pixel has data in both maps; they must overlap");
  return result;
}

HeightMap mean_map(const std::vector<HeightMap>& maps, Index least) {
  if (least < 1 || least > static_cast<Index>(maps.size())) {
    throw InputError(fmt::format("least = {} of {} maps; from 1 to {} required", least, maps.size(), maps.size()));
  }
  HeightMap result = maps.front();
  for (const HeightMap& map : maps) require_same_grid(result, map);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    double sum = 0.0;
    Index count = 0;
    for (const HeightMap& map : maps) {
      if (!std::isfinite(map.values[i])) continue;
      sum += map.values[i];
      ++count;
    }
    result.values[i] = count >= least ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
  }
  if (result.valid_pixels() == 0) throw InputError(fmt::format("no pixel has data in at least {} of the maps", least));
  return result;
}

}  // namespace dwell
