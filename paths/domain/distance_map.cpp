#include "paths/domain/distance_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/base/numbers.h"
#include "core/numerics/lower_envelope.h"

namespace dwell {
namespace {

Index margin_nodes(double margin, double extent, double pitch) {
  return static_cast<Index>(std::ceil(std::min(margin, extent) / pitch));
}

Index nearest_index(double offset, double pitch, Index count) {
  return static_cast<Index>(std::clamp(std::floor(offset / pitch + 0.5), 0.0, static_cast<double>(count - 1)));
}

}  // namespace

DistanceMap::DistanceMap(const HeightMap& map, double margin, const Progress& progress)
    : pixels_(map.grid), nodes_(map.grid) {
  if (!(std::isfinite(margin) && margin >= 0.0)) {
    throw InputError(fmt::format("distance map: margin = {} mm; required finite and >= 0", margin));
  }
  index_rows(map, progress);
  const Index margin_cols = margin_nodes(margin, pixels_.width(), pixels_.pitch_x);
  const Index margin_rows = margin_nodes(margin, pixels_.height(), pixels_.pitch_y);
  nodes_.cols += 2 * margin_cols;
  nodes_.rows += 2 * margin_rows;
  nodes_.origin = {pixels_.x(-margin_cols), pixels_.y(-margin_rows)};
  transform_columns(margin_rows, margin_cols, progress);
}

void DistanceMap::index_rows(const HeightMap& map, const Progress& progress) {
  const auto size = static_cast<std::size_t>(pixels_.size());
  valid_left_.resize(size);
  valid_right_.resize(size);
  bool any = false;
  for (Index row = 0; row < pixels_.rows; ++row) {
    progress.check();
    Index last = -1;
    for (Index col = 0; col < pixels_.cols; ++col) {
      if (std::isfinite(map.at(row, col))) last = col;
      valid_left_[static_cast<std::size_t>(pixels_.index(row, col))] = static_cast<std::int32_t>(last);
    }
    any = any || last >= 0;
    Index next = pixels_.cols;
    for (Index col = pixels_.cols - 1; col >= 0; --col) {
      if (std::isfinite(map.at(row, col))) next = col;
      valid_right_[static_cast<std::size_t>(pixels_.index(row, col))] = static_cast<std::int32_t>(next);
    }
  }
  if (!any) {
    throw InputError(
        fmt::format("map of {} x {} pixels has no finite value; at least one is required", pixels_.rows, pixels_.cols));
  }
}

/// Several columns at a time, since a row of the map is read along its columns.
void DistanceMap::transform_columns(Index margin_rows, Index margin_cols, const Progress& progress) {
  constexpr Index kTogether = 16;
  node_distance_.resize(static_cast<std::size_t>(nodes_.size()));
  const auto n = static_cast<std::size_t>(nodes_.rows);
  std::vector<std::vector<double>> along_row(kTogether, std::vector<double>(n, kInfinity)), distance = along_row;
  LowerEnvelope envelope(nodes_.rows, pixels_.pitch_y);
  for (Index begin = 0; begin < nodes_.cols; begin += kTogether) {
    progress.check();
    const Index count = std::min(kTogether, nodes_.cols - begin);
    for (Index row = 0; row < pixels_.rows; ++row) {
      const auto at = static_cast<std::size_t>(row + margin_rows);
      for (Index k = 0; k < count; ++k)
        along_row[static_cast<std::size_t>(k)][at] = squared_at_column(row, begin + k - margin_cols);
    }
    for (Index k = 0; k < count; ++k) {
      std::vector<double>& column = distance[static_cast<std::size_t>(k)];
      envelope(along_row[static_cast<std::size_t>(k)],
               [&](std::size_t row, double squared, std::size_t) { column[row] = std::sqrt(squared); });
    }
    for (Index row = 0; row < nodes_.rows; ++row) {
      double* to = &node_distance_[static_cast<std::size_t>(nodes_.index(row, begin))];
      for (Index k = 0; k < count; ++k) to[k] = distance[static_cast<std::size_t>(k)][static_cast<std::size_t>(row)];
    }
  }
}

double DistanceMap::squared_at_column(Index row, Index col) const {
  const auto pixel = static_cast<std::size_t>(pixels_.index(row, std::clamp<Index>(col, 0, pixels_.cols - 1)));
  const Index left = valid_left_[pixel], right = valid_right_[pixel];
  const double x = pixels_.x(col);
  double best = kInfinity;
  if (left >= 0) best = std::abs(x - pixels_.x(left));
  if (right < pixels_.cols) best = std::min(best, std::abs(x - pixels_.x(right)));
  return best * best;
}

double DistanceMap::squared_in_row(Index row, double x) const {
  const double offset = std::floor((x - pixels_.origin.x) / pixels_.pitch_x);
  const auto last_col = static_cast<double>(pixels_.cols - 1);
  const auto below = static_cast<Index>(std::clamp(offset, 0.0, last_col));
  const auto above = static_cast<Index>(std::clamp(offset + 1.0, 0.0, last_col));
  double best = kInfinity;
  // Rounding may put x on the wrong side of a column. A look to both sides from both columns costs nothing and is
  // exact.
  for (const Index col : {below, above}) {
    const Index left = valid_left_[static_cast<std::size_t>(pixels_.index(row, col))];
    const Index right = valid_right_[static_cast<std::size_t>(pixels_.index(row, col))];
    if (left >= 0) best = std::min(best, std::abs(x - pixels_.x(left)));
    if (right < pixels_.cols) best = std::min(best, std::abs(x - pixels_.x(right)));
  }
  return best * best;
}

DistanceMap::Bound DistanceMap::bound(Point p) const {
  const Index row = nearest_index(p.y - nodes_.origin.y, nodes_.pitch_y, nodes_.rows);
  const Index col = nearest_index(p.x - nodes_.origin.x, nodes_.pitch_x, nodes_.cols);
  const Point gap = p - nodes_.centre(row, col);
  // std::hypot would take as long as all the rest.
  return {at_node(row, col), std::sqrt(gap.x * gap.x + gap.y * gap.y)};
}

double DistanceMap::operator()(Point p) const {
  const Bound b = bound(p);
  const double most = (b.node + b.gap) * (1.0 + 1e-12);
  double best = most * most;
  const Index middle = nearest_index(p.y - pixels_.origin.y, pixels_.pitch_y, pixels_.rows);
  const auto visit = [&](Index row) {
    const double dy = p.y - pixels_.y(row);
    if (dy * dy > best) return false;
    best = std::min(best, dy * dy + squared_in_row(row, p.x));
    return true;
  };
  for (Index row = middle; row < pixels_.rows && visit(row);) ++row;
  for (Index row = middle - 1; row >= 0 && visit(row);) --row;
  return std::sqrt(best);
}

double DistanceMap::distance_to_grid(Point p) const {
  const double dx = std::max({pixels_.x(0) - p.x, p.x - pixels_.x(pixels_.cols - 1), 0.0});
  const double dy = std::max({pixels_.y(0) - p.y, p.y - pixels_.y(pixels_.rows - 1), 0.0});
  return std::hypot(dx, dy);
}

DistanceMap::Bounds DistanceMap::bounds(Point p) const {
  const Bound b = bound(p);
  const double rounding = 1e-9 * (b.node + b.gap);
  double low = std::max(b.node - b.gap - rounding, 0.0);
  if (b.gap > nodes_.pitch_x + nodes_.pitch_y) low = std::max(low, distance_to_grid(p));  // beyond the nodes
  return {low, b.node + b.gap + rounding};
}

bool DistanceMap::within(Point p, double reach) const {
  const Bounds b = bounds(p);
  if (b.high <= reach) return true;
  if (b.low > reach || distance_to_grid(p) > reach) return false;
  return (*this)(p) <= reach;
}

}  // namespace dwell
