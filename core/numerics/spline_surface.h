#pragma once

#include <vector>

#include "core/base/grid.h"

namespace dwell {

/// A smooth surface through samples on a grid: s(p) = sum_k c_k B3((x - x_k)/hx) B3((y - y_k)/hy), the cubic
/// B-spline that takes the sample at every grid point and zero on a ring of `kMargin` points around the grid.
/// Twice continuously differentiable, zero beyond the ring.
class SplineSurface {
 public:
  static constexpr Index kMargin = 4;  // the spline's ringing falls by 0.27 a sample

  SplineSurface() = default;
  /// values: row-major, one a grid point, all finite. Cost O(size).
  SplineSurface(const Grid& grid, const std::vector<double>& values);

  /// The surface with these coefficients, one a grid point, row-major. No ring.
  static SplineSurface with_coefficients(const Grid& grid, std::vector<double> coefficients);

  /// The surface at p, in the units of the samples. Cost O(1).
  double operator()(Point p) const;

  /// The surface and its slopes at p.
  struct Jet {
    double value = 0.0, by_x = 0.0, by_y = 0.0;
  };
  Jet jet(Point p) const;

  /// The grid of the coefficients: that of the samples with the ring.
  const Grid& grid() const { return grid_; }
  const std::vector<double>& coefficients() const { return c_; }

 private:
  Grid grid_;
  std::vector<double> c_;
};

}  // namespace dwell
