#include "core/map/map_outliers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/numerics/median.h"

namespace dwell {
namespace {

/// The median, of an even number the mean of the middle two. Reorders; at least one.
double median(std::vector<double>& v) {
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  if (v.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(v.begin(), middle));
}

bool is_outlier(const HeightMap& map, Index row, Index col, const OutlierOptions& options, std::vector<double>& near) {
  const Index half = options.window / 2;
  near.clear();
  for (Index r = std::max<Index>(row - half, 0); r <= std::min(row + half, map.grid.rows - 1); ++r) {
    for (Index c = std::max<Index>(col - half, 0); c <= std::min(col + half, map.grid.cols - 1); ++c) {
      if (std::isfinite(map.at(r, c))) near.push_back(map.at(r, c));
    }
  }
  if (static_cast<Index>(near.size()) < kLeastInOutlierWindow) return false;
  const double centre = median(near);
  const double away = std::abs(map.at(row, col) - centre);
  if (!(away > options.sigmas * options.floor)) return false;
  // Counting is cheaper than the second median: if fewer than half of the values are nearer than this, that median is
  // no less.
  const double nearer_than = away / (options.sigmas * kSigmaPerMedianDeviation);
  const auto nearer =
      std::count_if(near.begin(), near.end(), [&](double v) { return std::abs(v - centre) < nearer_than; });
  if (nearer < static_cast<std::ptrdiff_t>(near.size() / 2)) return false;
  for (double& v : near) v = std::abs(v - centre);
  return away > options.sigmas * std::max(kSigmaPerMedianDeviation * median(near), options.floor);
}

void check(const OutlierOptions& o) {
  if (!(std::isfinite(o.sigmas) && o.sigmas > 0.0)) {
    throw InputError(fmt::format("outliers: {} standard deviations; a finite number > 0 is required", o.sigmas));
  }
  if (o.window < 3 || o.window > kMaxOutlierWindow || o.window % 2 == 0) {
    throw InputError(fmt::format("outliers: window = {}; an odd number from 3 to {} is required",
                                 counted(o.window, "pixel"), kMaxOutlierWindow));
  }
  if (!(std::isfinite(o.floor) && o.floor >= 0.0)) {
    throw InputError(fmt::format("outliers: floor = {} nm; a finite number >= 0 is required", o.floor));
  }
}

/// The marked pixels become NaN. Returns how many had data.
Index take_out(HeightMap& map, const std::vector<unsigned char>& marked, const char* what) {
  const Index before = map.valid_pixels();
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (marked[i] != 0) map.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  const Index after = map.valid_pixels();
  if (after == 0)
    throw InputError(fmt::format("{}: all {} with data would be removed", what, counted(before, "pixel")));
  return before - after;
}

/// The steeper of the differences to the two neighbours of a line [nm/mm]; 0 without a neighbour.
double steeper(const HeightMap& map, Index row, Index col, Index down, Index right, double pitch) {
  double steepest = 0.0;
  for (const Index side : {-1, 1}) {
    const Index r = row + side * down, c = col + side * right;
    if (r < 0 || c < 0 || r >= map.grid.rows || c >= map.grid.cols || !std::isfinite(map.at(r, c))) continue;
    steepest = std::max(steepest, std::abs(map.at(r, c) - map.at(row, col)) / pitch);
  }
  return steepest;
}

}  // namespace

Index remove_outliers(HeightMap& map, const OutlierOptions& options, int threads, const Progress& progress) {
  check(options);
  std::vector<unsigned char> marked(map.values.size(), 0);
  const Index at_once = 2 * std::max(threads, 1);  // rows between reports: few, because a wide window takes long
  for (Index first = 0; first < map.grid.rows; first += at_once) {
    progress.step(fmt::format("outliers: row {} of {}", first, map.grid.rows));
    const Index end = std::min(first + at_once, map.grid.rows);
#pragma omp parallel num_threads(threads)
    {
      std::vector<double> near;
#pragma omp for schedule(static)
      for (Index row = first; row < end; ++row) {
        for (Index col = 0; col < map.grid.cols; ++col) {
          if (!std::isfinite(map.at(row, col))) continue;
          marked[static_cast<std::size_t>(map.grid.index(row, col))] = is_outlier(map, row, col, options, near) ? 1 : 0;
        }
      }
    }
  }
  return take_out(map, marked, "outliers");
}

Index remove_beyond(HeightMap& map, const LimitOptions& o) {
  if (!(o.height >= 0.0 && o.slope >= 0.0 && (o.height > 0.0 || o.slope > 0.0))) {
    throw InputError(fmt::format("limits of {} nm and {} nm/mm; both must be >= 0 and one > 0", o.height, o.slope));
  }
  std::vector<double> heights;
  for (const double v : map.values) {
    if (std::isfinite(v)) heights.push_back(v);
  }
  if (heights.empty()) throw InputError("limits: the map has no finite pixel; at least one is required");
  const double centre = median(heights);
  std::vector<unsigned char> marked(map.values.size(), 0);
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      const double height = map.at(row, col);
      if (!std::isfinite(height)) continue;
      const double slope =
          std::hypot(steeper(map, row, col, 0, 1, map.grid.pitch_x), steeper(map, row, col, 1, 0, map.grid.pitch_y));
      const bool beyond =
          (o.height > 0.0 && std::abs(height - centre) > o.height) || (o.slope > 0.0 && slope > o.slope);
      marked[static_cast<std::size_t>(map.grid.index(row, col))] = beyond ? 1 : 0;
    }
  }
  return take_out(map, marked, "limits");
}

}  // namespace dwell
