#include "core/removal/stroke_average.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/motion/stroke_quadrature.h"
#include "core/tif/line_integrals.h"

namespace dwell {

StrokeAverage::StrokeAverage(const RemovalFunction& tif)
    : kind_(tif.kind),
      radius_(tif.radius),
      peak_(tif.peak),
      sigma_(tif.sigma),
      slope_(tif.slope),
      low_{-tif.radius, -tif.radius},
      high_{tif.radius, tif.radius} {
  if (kind_ == RemovalFunction::Kind::Gaussian || kind_ == RemovalFunction::Kind::Disc) return;
  spline_.emplace(tif.samples.grid, tif.samples.values);
  samples_ = tif.samples.grid;
  const Grid& g = spline_->grid();  // B3 reaches two pitches beyond its coefficients
  low_ = {g.x(-2), g.y(-2)};
  high_ = {g.x(g.cols + 1), g.y(g.rows + 1)};
  reach_ = {(low_.x - samples_.origin.x) / samples_.pitch_x, (high_.x - samples_.origin.x) / samples_.pitch_x,
            (low_.y - samples_.origin.y) / samples_.pitch_y, (high_.y - samples_.origin.y) / samples_.pitch_y};
}

double StrokeAverage::rate(Point displacement) const {
  const double r = length(displacement);
  if (!(r <= radius_)) return 0.0;
  return kind_ == RemovalFunction::Kind::Disc ? slope_ * r : peak_ * std::exp(-0.5 * r * r / (sigma_ * sigma_));
}

/// Integral of the rate at `point` along a straight line [nm mm / s].
double StrokeAverage::piece(Point from, Point to, Point point) const {
  const Point a = from - point, along = to - from;
  const double total = length(along);
  if (!(total > 0.0)) return 0.0;
  const double d = std::abs(a.x * along.y - a.y * along.x) / total;
  if (!(d < radius_)) return 0.0;
  const double start = (a.x * along.x + a.y * along.y) / total;
  const double chord = std::sqrt((radius_ - d) * (radius_ + d));
  const double u0 = std::max(start, -chord), u1 = std::min(start + total, chord);
  if (!(u0 < u1)) return 0.0;
  const double width = u0 > start || u1 < start + total ? u1 - u0 : total;  // u1 - u0 is rounded on the scale of u0
  if (kind_ == RemovalFunction::Kind::Disc) return slope_ * integral_of_distance(d, u0, u1, width);
  return peak_ * std::exp(-0.5 * d * d / (sigma_ * sigma_)) * integral_of_gaussian(sigma_, u0, u1, width);
}

double StrokeAverage::spline_average(const Stroke& stroke, Point point) const {
  // Kept from call to call, because every entry of a matrix would allocate it anew.
  thread_local std::vector<QuadraturePoint> points;
  points.clear();
  append_stroke_quadrature({point - stroke.start, point - stroke.via, point - stroke.finish}, samples_, reach_, points);
  double sum = 0.0;
  for (const QuadraturePoint& q : points) sum += q.weight * (*spline_)(q.position);
  return sum;
}

double StrokeAverage::operator()(const Stroke& stroke, Point point) const {
  if (spline_) return spline_average(stroke, point);
  const double total = stroke.length();
  if (!(total > 0.0)) return rate(point - stroke.via);
  return (piece(stroke.start, stroke.via, point) + piece(stroke.via, stroke.finish, point)) / total;
}

}  // namespace dwell
