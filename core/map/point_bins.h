#pragma once

#include <vector>

#include "core/base/grid.h"

namespace dwell {

struct HeightPoint {
  Point position;  // [mm]
  double height = 0.0;
};

/// Points sorted into square cells, to find those near a place. Places of points must be finite, at least one.
class PointBins {
 public:
  explicit PointBins(std::vector<HeightPoint> points);

  /// Calls visit(point, square of the distance [mm^2]) for all points within `radius` of a place, in an order that
  /// depends on nothing but the points.
  template <class Visit>
  void within(Point place, double radius, Visit visit) const {
    const double limit = radius * radius;
    const Index row_0 = bounded(row_of(place.y - radius), rows_), row_1 = bounded(row_of(place.y + radius), rows_);
    const Index col_0 = bounded(col_of(place.x - radius), cols_), col_1 = bounded(col_of(place.x + radius), cols_);
    for (Index row = row_0; row <= row_1; ++row) {
      const auto begin = begin_[static_cast<std::size_t>(row * cols_ + col_0)];
      const auto end = begin_[static_cast<std::size_t>(row * cols_ + col_1 + 1)];
      for (std::size_t i = begin; i < end; ++i) {
        const double dx = points_[i].position.x - place.x, dy = points_[i].position.y - place.y;
        const double square = dx * dx + dy * dy;
        if (square <= limit) visit(points_[i], square);
      }
    }
  }

  const std::vector<HeightPoint>& points() const { return points_; }
  /// The spacing of a square grid that fills the points' rectangle [mm], > 0 unless all points are at one place.
  double mean_spacing() const { return spacing_; }

 private:
  double row_of(double y) const { return (y - low_.y) / cell_; }
  double col_of(double x) const { return (x - low_.x) / cell_; }
  static Index bounded(double k, Index count);

  std::vector<HeightPoint> points_;  // cell by cell
  std::vector<std::size_t> begin_;   // of each cell, and the end
  Point low_;
  double cell_ = 1.0, spacing_ = 0.0;
  Index rows_ = 1, cols_ = 1;
};

}  // namespace dwell
