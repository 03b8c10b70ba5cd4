#pragma once

#include <cmath>
#include <vector>

#include "core/base/grid.h"
#include "core/numerics/bspline.h"

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
  /// The same where all 4 x 4 coefficients about p lie on the grid: from node 1 to the last but two along both axes.
  /// Outside of that it reads beyond the coefficients.
  double value_inside(Point p) const {
    const double u = (p.x - grid_.origin.x) / grid_.pitch_x, v = (p.y - grid_.origin.y) / grid_.pitch_y;
    const double fu = std::floor(u), fv = std::floor(v);
    const auto wx = bspline_weights(u - fu), wy = bspline_weights(v - fv);
    const double* c = c_.data() + grid_.index(static_cast<Index>(fv) - 1, static_cast<Index>(fu) - 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i, c += grid_.cols)
      sum += wy[i] * (wx[0] * c[0] + wx[1] * c[1] + wx[2] * c[2] + wx[3] * c[3]);
    return sum;
  }

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
