#include "core/numerics/spline_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/bspline.h"

namespace dwell {
namespace {

/// Solves (c[k-1] + 4 c[k] + c[k+1]) / 6 = s[k], c = 0 beyond the ends, in place along a strided line (Thomas).
void interpolate_line(double* c, Index n, Index stride, std::vector<double>& ratio) {
  ratio.resize(static_cast<std::size_t>(n));
  double previous = 0.0;
  for (Index k = 0; k < n; ++k) {
    const double denominator = 4.0 - (k > 0 ? ratio[static_cast<std::size_t>(k - 1)] : 0.0);
    ratio[static_cast<std::size_t>(k)] = 1.0 / denominator;
    previous = (6.0 * c[k * stride] - previous) / denominator;
    c[k * stride] = previous;
  }
  for (Index k = n - 2; k >= 0; --k) c[k * stride] -= ratio[static_cast<std::size_t>(k)] * c[(k + 1) * stride];
}

}  // namespace

SplineSurface::SplineSurface(const Grid& grid, const std::vector<double>& values) : grid_(grid) {
  grid_.rows += 2 * kMargin;
  grid_.cols += 2 * kMargin;
  grid_.origin.x -= static_cast<double>(kMargin) * grid.pitch_x;
  grid_.origin.y -= static_cast<double>(kMargin) * grid.pitch_y;
  c_.assign(static_cast<std::size_t>(grid_.size()), 0.0);
  for (Index r = 0; r < grid.rows; ++r) {
    std::copy_n(values.begin() + r * grid.cols, grid.cols, c_.begin() + grid_.index(r + kMargin, kMargin));
  }
  std::vector<double> scratch;
  for (Index r = 0; r < grid_.rows; ++r)
    interpolate_line(&c_[static_cast<std::size_t>(r * grid_.cols)], grid_.cols, 1, scratch);
  for (Index c = 0; c < grid_.cols; ++c)
    interpolate_line(&c_[static_cast<std::size_t>(c)], grid_.rows, grid_.cols, scratch);
}

SplineSurface SplineSurface::with_coefficients(const Grid& grid, std::vector<double> coefficients) {
  SplineSurface surface;
  surface.grid_ = grid;
  surface.c_ = std::move(coefficients);
  return surface;
}

SplineSurface::Jet SplineSurface::jet(Point p) const {
  const double u = (p.x - grid_.origin.x) / grid_.pitch_x;
  const double v = (p.y - grid_.origin.y) / grid_.pitch_y;
  Jet jet;
  if (!(u > -2.0 && v > -2.0 && u < static_cast<double>(grid_.cols) + 1.0 &&
        v < static_cast<double>(grid_.rows) + 1.0)) {
    return jet;
  }
  const double fu = std::floor(u), fv = std::floor(v);
  const auto wx = bspline_weights(u - fu), wy = bspline_weights(v - fv);
  const auto sx = bspline_slopes(u - fu), sy = bspline_slopes(v - fv);
  const Index col = static_cast<Index>(fu) - 1, row = static_cast<Index>(fv) - 1;
  for (Index i = 0; i < 4; ++i) {
    const Index r = row + i;
    if (r < 0 || r >= grid_.rows) continue;
    double across = 0.0, slope = 0.0;
    for (Index j = std::max<Index>(0, -col); j < std::min<Index>(4, grid_.cols - col); ++j) {
      const double c = c_[static_cast<std::size_t>(grid_.index(r, col + j))];
      across += wx[static_cast<std::size_t>(j)] * c;
      slope += sx[static_cast<std::size_t>(j)] * c;
    }
    const auto k = static_cast<std::size_t>(i);
    jet.value += wy[k] * across;
    jet.by_x += wy[k] * slope / grid_.pitch_x;
    jet.by_y += sy[k] * across / grid_.pitch_y;
  }
  return jet;
}

double SplineSurface::operator()(Point p) const {
  const double u = (p.x - grid_.origin.x) / grid_.pitch_x;
  const double v = (p.y - grid_.origin.y) / grid_.pitch_y;
  if (!(u > -2.0 && v > -2.0 && u < static_cast<double>(grid_.cols) + 1.0 &&
        v < static_cast<double>(grid_.rows) + 1.0)) {
    return 0.0;
  }
  if (u >= 1.0 && v >= 1.0 && u < static_cast<double>(grid_.cols - 2) && v < static_cast<double>(grid_.rows - 2)) {
    return value_inside(p);
  }
  const double fu = std::floor(u), fv = std::floor(v);
  const auto wx = bspline_weights(u - fu), wy = bspline_weights(v - fv);
  const Index col = static_cast<Index>(fu) - 1, row = static_cast<Index>(fv) - 1;
  double sum = 0.0;
  for (Index i = 0; i < 4; ++i) {
    const Index r = row + i;
    if (r < 0 || r >= grid_.rows) continue;
    for (Index j = 0; j < 4; ++j) {
      const Index c = col + j;
      if (c < 0 || c >= grid_.cols) continue;
      sum += wy[static_cast<std::size_t>(i)] * wx[static_cast<std::size_t>(j)] *
             c_[static_cast<std::size_t>(grid_.index(r, c))];
    }
  }
  return sum;
}

}  // namespace dwell
