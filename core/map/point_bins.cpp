#include "core/map/point_bins.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

constexpr double kSpacingsPerCell = 2.0;  // about four points a cell

}  // namespace

Index PointBins::bounded(double k, Index count) {
  return static_cast<Index>(std::clamp(std::floor(k), 0.0, static_cast<double>(count - 1)));
}

PointBins::PointBins(std::vector<HeightPoint> points) : points_(std::move(points)) {
  Point high = points_.front().position;
  low_ = high;
  for (const HeightPoint& point : points_) {
    low_ = {std::min(low_.x, point.position.x), std::min(low_.y, point.position.y)};
    high = {std::max(high.x, point.position.x), std::max(high.y, point.position.y)};
  }
  const double width = high.x - low_.x, height = high.y - low_.y, longer = std::max(width, height);
  const auto count = static_cast<double>(points_.size());
  // Points on a line are as far apart as they are along it; never more cells than four times the points.
  spacing_ = std::max(std::sqrt(width * height / count), longer / count);
  if (spacing_ > 0.0) cell_ = kSpacingsPerCell * spacing_;
  rows_ = static_cast<Index>(std::floor(height / cell_)) + 1;
  cols_ = static_cast<Index>(std::floor(width / cell_)) + 1;
  const auto cell_of = [&](const HeightPoint& point) {
    const Index cell = bounded(row_of(point.position.y), rows_) * cols_ + bounded(col_of(point.position.x), cols_);
    return static_cast<std::size_t>(cell);
  };
  begin_.assign(static_cast<std::size_t>(rows_ * cols_) + 1, 0);
  for (const HeightPoint& point : points_) ++begin_[cell_of(point) + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  std::vector<HeightPoint> sorted(points_.size());
  for (const HeightPoint& point : points_) sorted[next[cell_of(point)]++] = point;
  points_ = std::move(sorted);
}

}  // namespace dwell
