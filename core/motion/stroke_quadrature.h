#pragma once

#include <vector>

#include "core/base/grid.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// A position of the tool with its share of a stroke's time.
struct QuadraturePoint {
  Point position;
  double weight;
};

/// A rectangle in pitches of a lattice from its origin: x runs along u, y along v.
struct LatticeBox {
  double low_u, high_u, low_v, high_v;

  bool holds(double u, double v) const { return u >= low_u && u <= high_u && v >= low_v && v <= high_v; }
};

/// Appends points and weights that sum to one. With them, the weighted sum of any cubic spline on the lattice of `grid`
/// is the spline's exact average along the stroke: the stroke is cut where it crosses a lattice line and every piece
/// takes the 4-point Gauss-Legendre rule, which is exact to degree 7, while the product spline along a line has degree
/// 6. A halt is one point. Cost O(lattice lines crossed).
void append_stroke_quadrature(const Stroke& stroke, const Grid& grid, std::vector<QuadraturePoint>& points);

/// The same without the parts of the stroke that lie outside a box, for splines that are zero there: weights then sum
/// to the share of the stroke's time that it spends in the box. Cost O(lattice lines crossed in the box).
void append_stroke_quadrature(const Stroke& stroke, const Grid& grid, const LatticeBox& reach,
                              std::vector<QuadraturePoint>& points);

}  // namespace dwell
