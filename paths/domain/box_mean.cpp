#include "paths/domain/box_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/errors.h"

namespace dwell {
namespace {

/// line[i] <- sum of line[i - half .. i + half], by running sums over blocks no longer than the window, so that only
/// the terms of a sum contribute to its rounding.
void sum_windows(std::vector<double>& line, Index half) {
  const auto n = static_cast<Index>(line.size());
  const Index width = 2 * half + 1;
  // Window [a, a + width) = the end of one block of `width` and the beginning of the next.
  std::vector<double> from_left(line.size()), from_right(line.size());
  const auto at = [](std::vector<double>& v, Index i) -> double& { return v[static_cast<std::size_t>(i)]; };
  for (Index i = 0; i < n; ++i) at(from_left, i) = at(line, i) + (i % width == 0 ? 0.0 : at(from_left, i - 1));
  for (Index i = n - 1; i >= 0; --i) {
    at(from_right, i) = at(line, i) + (i == n - 1 || (i + 1) % width == 0 ? 0.0 : at(from_right, i + 1));
  }
  for (Index i = 0; i < n; ++i) {
    const Index a = std::max<Index>(0, i - half), b = std::min(n - 1, i + half);
    if (a / width != b / width) {
      at(line, i) = at(from_right, a) + at(from_left, b);
    } else if (a % width == 0) {
      at(line, i) = at(from_left, b);
    } else {
      at(line, i) = at(from_right, a);
    }
  }
}

Index half_width(double side, double pitch, Index count) {
  return static_cast<Index>(std::min(std::floor(0.5 * side / pitch), static_cast<double>(count)));
}

/// Sums over the box at every pixel.
void sum_boxes(const Grid& g, std::vector<double>& values, Index half_cols, Index half_rows, const Progress& progress) {
  std::vector<double> line;
  for (Index row = 0; row < g.rows && half_cols > 0; ++row) {
    progress.check();
    line.assign(values.begin() + g.index(row, 0), values.begin() + g.index(row, 0) + g.cols);
    sum_windows(line, half_cols);
    std::copy(line.begin(), line.end(), values.begin() + g.index(row, 0));
  }
  line.resize(static_cast<std::size_t>(g.rows));
  for (Index col = 0; col < g.cols && half_rows > 0; ++col) {
    progress.check();
    for (Index row = 0; row < g.rows; ++row) {
      line[static_cast<std::size_t>(row)] = values[static_cast<std::size_t>(g.index(row, col))];
    }
    sum_windows(line, half_rows);
    for (Index row = 0; row < g.rows; ++row) {
      values[static_cast<std::size_t>(g.index(row, col))] = line[static_cast<std::size_t>(row)];
    }
  }
}

}  // namespace

HeightMap box_mean(const HeightMap& map, double side, const Progress& progress) {
  if (!(std::isfinite(side) && side >= 0.0)) {
    throw InputError(fmt::format("box mean: side = {} mm; required finite and >= 0", side));
  }
  const Index half_cols = half_width(side, map.grid.pitch_x, map.grid.cols);
  const Index half_rows = half_width(side, map.grid.pitch_y, map.grid.rows);
  if (half_cols == 0 && half_rows == 0) return map;
  std::vector<double> sums(map.values.size()), counts(map.values.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const bool valid = std::isfinite(map.values[i]);
    sums[i] = valid ? map.values[i] : 0.0;
    counts[i] = valid ? 1.0 : 0.0;
  }
  sum_boxes(map.grid, sums, half_cols, half_rows, progress);
  sum_boxes(map.grid, counts, half_cols, half_rows, progress);
  HeightMap mean = map;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (std::isfinite(mean.values[i])) mean.values[i] = sums[i] / counts[i];
  }
  return mean;
}

}  // namespace dwell
