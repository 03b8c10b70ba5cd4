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

/// Appends points and weights that sum to one. With them, the weighted sum of any cubic spline on the lattice of `grid`
/// is the spline's exact average along the stroke: the stroke is cut where it crosses a lattice line and every piece
/// takes the 4-point Gauss-Legendre rule, which is exact to degree 7, while the product spline along a line has degree
/// 6. A halt is one point. Cost O(lattice lines crossed).
void append_stroke_quadrature(const Stroke& stroke, const Grid& grid, std::vector<QuadraturePoint>& points);

}  // namespace dwell
