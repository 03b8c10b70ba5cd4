#include "core/map/map_sampler.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/map/nearest_pixel.h"

namespace dwell {
namespace {

constexpr Index kRings = 3;
constexpr Index kPadding = 12;  // pixels around the map: the influence of what lies beyond falls to 0.27^12 over them

HeightMap pad_map(const HeightMap& map, double mean) {
  const Grid& g = map.grid;
  HeightMap wide(
      Grid{g.rows + 2 * kPadding, g.cols + 2 * kPadding, g.pitch_x, g.pitch_y, g.centre(-kPadding, -kPadding)});
  for (Index r = 0; r < g.rows; ++r) {
    for (Index c = 0; c < g.cols; ++c) wide.at(r + kPadding, c + kPadding) = map.at(r, c) - mean;
  }
  return wide;
}

/// The height by linear continuation from the finite pixels around; NaN where no neighbour is finite.
double continue_linearly(const HeightMap& map, Index row, Index col) {
  double linear = 0.0, constant = 0.0;
  int lines = 0, neighbours = 0;
  for (Index dr = -1; dr <= 1; ++dr) {
    for (Index dc = -1; dc <= 1; ++dc) {
      const auto height = [&](Index steps) {
        const Index r = row + steps * dr, c = col + steps * dc;
        const bool in = r >= 0 && c >= 0 && r < map.grid.rows && c < map.grid.cols;
        return in ? map.at(r, c) : std::numeric_limits<double>::quiet_NaN();
      };
      const double first = height(1), second = height(2);
      if (!std::isfinite(first)) continue;
      constant += first;
      ++neighbours;
      if (!std::isfinite(second)) continue;
      linear += 2.0 * first - second;
      ++lines;
    }
  }
  if (lines > 0) return linear / lines;
  return neighbours > 0 ? constant / neighbours : std::numeric_limits<double>::quiet_NaN();
}

void add_ring(HeightMap& map) {
  std::vector<std::pair<std::size_t, double>> ring;
  for (Index r = 0; r < map.grid.rows; ++r) {
    for (Index c = 0; c < map.grid.cols; ++c) {
      if (std::isfinite(map.at(r, c))) continue;
      const double height = continue_linearly(map, r, c);
      if (std::isfinite(height)) ring.emplace_back(static_cast<std::size_t>(map.grid.index(r, c)), height);
    }
  }
  for (const auto& [pixel, height] : ring) map.values[pixel] = height;
}

double mean_of(const HeightMap& map) {
  double sum = 0.0;
  Index count = 0;
  for (const double height : map.values) {
    if (!std::isfinite(height)) continue;
    sum += height;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

MapSampler::MapSampler(const HeightMap& map, const Progress& progress) : grid_(map.grid), mean_(mean_of(map)) {
  valid_.reserve(map.values.size());
  for (const double height : map.values) valid_.push_back(std::isfinite(height) ? 1 : 0);
  HeightMap wide = pad_map(map, mean_);
  for (Index ring = 0; ring < kRings; ++ring) {
    progress.check();
    add_ring(wide);
  }
  progress.check();
  const std::vector<Index> nearest = nearest_pixels(wide);
  for (std::size_t i = 0; i < nearest.size(); ++i) wide.values[i] = wide.values[static_cast<std::size_t>(nearest[i])];
  progress.check();
  surface_ = SplineSurface(wide.grid, wide.values);
}

bool MapSampler::has_data(Point p) const {
  constexpr double kOnPixel = 1e-9;
  // First and last pixel of a line that bilinear interpolation at u uses.
  const auto used = [](double u) {
    const double nearest = std::round(u);
    if (std::abs(u - nearest) <= kOnPixel) return std::pair{nearest, nearest};
    return std::pair{std::floor(u), std::floor(u) + 1.0};
  };
  const auto cols = used((p.x - grid_.origin.x) / grid_.pitch_x);
  const auto rows = used((p.y - grid_.origin.y) / grid_.pitch_y);
  if (!(cols.first >= 0.0 && cols.second < static_cast<double>(grid_.cols) && rows.first >= 0.0 &&
        rows.second < static_cast<double>(grid_.rows))) {
    return false;
  }
  for (auto row = static_cast<Index>(rows.first); row <= static_cast<Index>(rows.second); ++row) {
    for (auto col = static_cast<Index>(cols.first); col <= static_cast<Index>(cols.second); ++col) {
      if (valid_[static_cast<std::size_t>(grid_.index(row, col))] == 0) return false;
    }
  }
  return true;
}

double MapSampler::operator()(Point p) const {
  return has_data(p) ? mean_ + surface_(p) : std::numeric_limits<double>::quiet_NaN();
}

SplineSurface::Jet MapSampler::jet(Point p) const {
  SplineSurface::Jet jet = surface_.jet(p);
  jet.value += mean_;
  return jet;
}

}  // namespace dwell
