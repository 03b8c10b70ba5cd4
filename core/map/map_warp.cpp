#include "core/map/map_warp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/base/memory.h"
#include "core/map/map_sampler.h"

namespace dwell {
namespace {

/// The new map, and of the old one a wider copy and the spline through it.
void require_memory_to_warp(const Grid& from, const Grid& onto) {
  constexpr double kSpline = 2.0;
  require_memory(sizeof(double) * (static_cast<double>(onto.size()) + kSpline * static_cast<double>(from.size())),
                 fmt::format("resampling {} x {} pixels onto {} x {}", from.rows, from.cols, onto.rows, onto.cols));
}

}  // namespace

HeightMap warp_map(const HeightMap& map, const PlaneTransform& forward, const Grid& target, int threads,
                   const Progress& progress) {
  const PlaneTransform back = forward.inverse();
  require_memory_to_warp(map.grid, target);
  progress.step("the spline through the map");
  const MapSampler sampler(map, progress);
  HeightMap result(target);
  constexpr Index kBetweenLooks = Index{1} << 20;  // pixels: a tenth of a second
  const Index band = std::max<Index>(threads, kBetweenLooks / target.cols);
  for (Index first = 0; first < target.rows; first += band) {
    progress.step(fmt::format("resampling: {} %", 100 * first / target.rows));
    const Index end = std::min(first + band, target.rows);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (Index row = first; row < end; ++row) {
      for (Index col = 0; col < target.cols; ++col) result.at(row, col) = sampler(back(target.centre(row, col)));
    }
  }
  if (result.valid_pixels() == 0) {
    throw InputError(
        fmt::format("the moved map has no data on the grid of x = {} to {} mm, y = {} to {} mm; they must overlap",
                    target.x(0), target.x(target.cols - 1), target.y(0), target.y(target.rows - 1)));
  }
  result.history = map.history;
  return result;
}

Grid covering_grid(const Grid& grid, const PlaneTransform& forward, const PixelLimit& limit) {
  const double half_x = 0.5 * grid.pitch_x * static_cast<double>(grid.cols - 1);
  const double half_y = 0.5 * grid.pitch_y * static_cast<double>(grid.rows - 1);
  const double reach_x = std::abs(forward.xx) * half_x + std::abs(forward.xy) * half_y;
  const double reach_y = std::abs(forward.yx) * half_x + std::abs(forward.yy) * half_y;
  constexpr double kRounding = 1e-9;  // pixels
  const double cols = std::ceil(2.0 * reach_x / grid.pitch_x - kRounding) + 1.0;
  const double rows = std::ceil(2.0 * reach_y / grid.pitch_y - kRounding) + 1.0;
  Grid result = limited_grid(rows, cols, {grid.pitch_x, grid.pitch_y}, {}, "moving the map", limit);
  result.origin = forward(middle_of(grid)) - middle_of(result);
  return result;
}

HeightMap rotate_map(const HeightMap& map, double degrees, Point about, int threads, const PixelLimit& limit,
                     const Progress& progress) {
  const PlaneTransform forward = similarity(about, {}, degrees, 1.0);
  return warp_map(map, forward, covering_grid(map.grid, forward, limit), threads, progress);
}

}  // namespace dwell
