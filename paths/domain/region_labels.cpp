#include "paths/domain/region_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/map/nearest_pixel.h"
#include "paths/domain/rounding.h"

namespace dwell {
namespace {

constexpr double kMostPixels = 1e8;

double longest(const std::vector<double>& reaches) { return *std::max_element(reaches.begin(), reaches.end()); }

Grid widen_grid(const Grid& grid, double reach, const char* planner) {
  const double cols = std::ceil(reach / grid.pitch_x) + 1.0, rows = std::ceil(reach / grid.pitch_y) + 1.0;
  const double pixels = (static_cast<double>(grid.cols) + 2.0 * cols) * (static_cast<double>(grid.rows) + 2.0 * rows);
  if (!(pixels <= kMostPixels)) {
    throw InputError(
        fmt::format("{}: the map with {:.6g} mm beyond its edge has {:.3g} pixels; at most {:.0e} accepted, make "
                    "overrun, pitch or step smaller",
                    planner, reach, pixels, kMostPixels));
  }
  const auto c = static_cast<Index>(cols), r = static_cast<Index>(rows);
  return {grid.rows + 2 * r, grid.cols + 2 * c, grid.pitch_x, grid.pitch_y, {grid.x(-c), grid.y(-r)}};
}

}  // namespace

RegionLabels::RegionLabels(const HeightMap& map, const std::vector<std::int32_t>& regions,
                           const std::vector<double>& reaches, const char* planner, const Progress& progress)
    : grid_(widen_grid(map.grid, longest(reaches), planner)),
      origin_{grid_.origin.x - 0.5 * grid_.pitch_x, grid_.origin.y - 0.5 * grid_.pitch_y},
      per_pitch_{1.0 / grid_.pitch_x, 1.0 / grid_.pitch_y},
      rows_(static_cast<double>(grid_.rows)),
      cols_(static_cast<double>(grid_.cols)),
      padded_{0.0},
      labels_(static_cast<std::size_t>(grid_.size()), 0),
      distance_(map, longest(reaches), progress) {
  for (const double reach : reaches) {
    padded_.push_back(reach + kRounding * std::min(grid_.pitch_x, grid_.pitch_y));
  }
  const Index margin_rows = (grid_.rows - map.grid.rows) / 2, margin_cols = (grid_.cols - map.grid.cols) / 2;
  HeightMap wide(grid_);
  for (const Index i : finite_pixels(map)) {
    wide.at(i / map.grid.cols + margin_rows, i % map.grid.cols + margin_cols) =
        static_cast<double>(regions[static_cast<std::size_t>(i)]);
  }
  const std::vector<Index> nearest = nearest_pixels(wide, progress);
  const double half_diagonal = 0.5 * std::hypot(grid_.pitch_x, grid_.pitch_y);
  Poll poll(progress);
  for (Index i = 0; i < grid_.size(); ++i) {
    poll.step();
    const Index from = nearest[static_cast<std::size_t>(i)];
    const auto region = static_cast<std::int32_t>(wide.values[static_cast<std::size_t>(from)]);
    const double reach = padded_[static_cast<std::size_t>(region)];
    const double away = from == i ? -half_diagonal : distance(grid_.centre(i), grid_.centre(from));
    std::int32_t& label = labels_[static_cast<std::size_t>(i)];
    if (away + half_diagonal <= reach) {
      label = region;
    } else if (away - half_diagonal <= reach) {
      label = -region;
    }
  }
}

}  // namespace dwell
