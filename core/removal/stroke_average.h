#pragma once

#include <optional>

#include "core/motion/stroke_quadrature.h"
#include "core/motion/tool_path.h"
#include "core/numerics/spline_surface.h"
#include "core/tif/removal_function.h"

namespace dwell {

/// The removal rate at a point, averaged over a stroke: an entry of the removal operator, but of the removal function
/// as it was given and not of the spline through its samples on the map's pitch (docs/math.md, "Exact averages").
///
/// A straight piece passes the point at the distance d; with u measured along it from the foot of the perpendicular,
/// only |u| <= sqrt(radius^2 - d^2) counts, and there
///   disc       mean of slope sqrt(u^2 + d^2), in closed form (Lin et al. 2014, equations 5, 19-28, for any direction)
///   Gaussian   mean of peak exp(-(u^2 + d^2) / 2 sigma^2), by the error function
///   samples    (measured, model): the spline through them on their own grid, piecewise polynomial, by Gauss-Legendre
/// Exact to rounding: about 1e-14 of the peak, however short the stroke; 1e-8 where the cut-off circle only touches a
/// piece, because rounding enters there under a square root.
class StrokeAverage {
 public:
  explicit StrokeAverage(const RemovalFunction& tif);

  /// [nm/s]. A halt gives the rate at the displacement point - via. Cost O(1); of samples, O(lattice lines crossed).
  double operator()(const Stroke& stroke, Point point) const;

  /// No removal outside the displacements [low, high] from the tool axis [mm].
  Point low() const { return low_; }
  Point high() const { return high_; }

 private:
  double rate(Point displacement) const;
  double piece(Point from, Point to, Point point) const;
  double spline_average(const Stroke& stroke, Point point) const;

  RemovalFunction::Kind kind_;
  double radius_, peak_, sigma_, slope_;
  std::optional<SplineSurface> spline_;
  Grid samples_;
  Point low_, high_;
  LatticeBox reach_{};  // the same in pitches of the samples
};

}  // namespace dwell
