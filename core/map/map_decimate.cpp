#include "core/map/map_decimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/base/poll.h"
#include "core/base/value_range.h"
#include "core/map/map_warp.h"

namespace dwell {
namespace {

/// Blocks along an axis that may have half of their pixels.
Index blocks_along(Index pixels, Index factor) {
  return pixels / factor + (2 * (pixels % factor) >= factor && pixels % factor > 0 ? 1 : 0);
}

/// The finite pixels of a block, averaged.
double block_mean(const HeightMap& map, Index row, Index col, Index row_factor, Index col_factor) {
  double sum = 0.0;
  Index count = 0;
  for (Index r = row; r < std::min(row + row_factor, map.grid.rows); ++r) {
    for (Index c = col; c < std::min(col + col_factor, map.grid.cols); ++c) {
      if (!std::isfinite(map.at(r, c))) continue;
      sum += map.at(r, c);
      ++count;
    }
  }
  const bool enough = 2.0 * static_cast<double>(count) >= static_cast<double>(row_factor * col_factor);
  return enough ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

/// How many of the map's pixels a new one spans: whole, at least one.
Index span_of(double pitch, double old_pitch, Index pixels) {
  const double span = std::floor(pitch / old_pitch + 1e-9);
  return static_cast<Index>(std::clamp(span, 1.0, static_cast<double>(2 * pixels)));
}

}  // namespace

HeightMap decimate_map(const HeightMap& map, Index row_factor, Index col_factor, const Progress& progress) {
  const Grid& g = map.grid;
  if (row_factor < 1 || col_factor < 1) {
    throw InputError(fmt::format("blocks of {} x {} pixels; at least 1 x 1 required", row_factor, col_factor));
  }
  // A block larger than twice the map cannot be half full; this also keeps the products below small.
  if (row_factor > 2 * g.rows || col_factor > 2 * g.cols || blocks_along(g.rows, row_factor) == 0 ||
      blocks_along(g.cols, col_factor) == 0) {
    throw InputError(fmt::format("blocks of {} x {} pixels are too large for a map of {} x {}", row_factor, col_factor,
                                 g.rows, g.cols));
  }
  const double rows = static_cast<double>(row_factor), cols = static_cast<double>(col_factor);
  HeightMap result(Grid{blocks_along(g.rows, row_factor),
                        blocks_along(g.cols, col_factor),
                        cols * g.pitch_x,
                        rows * g.pitch_y,
                        {g.origin.x + 0.5 * (cols - 1.0) * g.pitch_x, g.origin.y + 0.5 * (rows - 1.0) * g.pitch_y}});
  Poll poll(progress);
  for (Index r = 0; r < result.grid.rows; ++r) {
    for (Index c = 0; c < result.grid.cols; ++c) {
      poll.step();
      result.at(r, c) = block_mean(map, r * row_factor, c * col_factor, row_factor, col_factor);
    }
  }
  if (result.valid_pixels() == 0) {
    throw InputError(fmt::format("no block of {} x {} pixels has data in half of its pixels", row_factor, col_factor));
  }
  result.history = map.history;
  return result;
}

HeightMap resample_map(const HeightMap& map, Point pitch, int threads, const PixelLimit& limit,
                       const Progress& progress) {
  if (!ranges::kPitch.holds(pitch.x) || !ranges::kPitch.holds(pitch.y)) {
    throw InputError(
        fmt::format("pitch = {} x {} mm; both must be finite and > 0, {}", pitch.x, pitch.y, ranges::kPitch.text()));
  }
  const Index across = span_of(pitch.x, map.grid.pitch_x, map.grid.cols);
  const Index along = span_of(pitch.y, map.grid.pitch_y, map.grid.rows);
  const bool coarser = across > 1 || along > 1;
  const HeightMap averaged = coarser ? decimate_map(map, along, across, progress) : HeightMap();
  const HeightMap& source = coarser ? averaged : map;
  constexpr double kRounding = 1e-9;  // pixels
  const auto points = [](double old_pitch, Index pixels, double new_pitch) {
    return std::floor(static_cast<double>(pixels - 1) * old_pitch / new_pitch + kRounding) + 1.0;
  };
  const Grid& g = source.grid;
  const Grid target = limited_grid(points(g.pitch_y, g.rows, pitch.y), points(g.pitch_x, g.cols, pitch.x), pitch,
                                   g.origin, fmt::format("pitch = {} x {} mm", pitch.x, pitch.y), limit);
  return warp_map(source, {}, target, threads, progress);
}

}  // namespace dwell
