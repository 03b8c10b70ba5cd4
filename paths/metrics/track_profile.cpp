#include "paths/metrics/track_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "core/base/errors.h"
#include "core/numerics/spline_surface.h"
#include "paths/domain/feed_direction.h"

namespace dwell {
namespace {

constexpr double kHalf = 0.5;  // of a sample: step of the quadrature and of its table

Point checked_direction(double angle_deg) {
  if (std::isfinite(angle_deg)) return feed_direction(angle_deg);
  throw InputError(fmt::format("track: angle = {} degrees; required finite", angle_deg));
}

Point left_of(Point along) { return {-along.y, along.x}; }

/// Half the length of a disc's chord at the distance v from its middle.
double half_chord(double radius, double v) { return std::sqrt(std::max(0.0, (radius - v) * (radius + v))); }

double gaussian_line(const RemovalFunction& tif, double v) {
  const double w = half_chord(tif.radius, v);
  const double root2_sigma = std::numbers::sqrt2 * tif.sigma;
  return tif.peak * std::exp(-v * v / (root2_sigma * root2_sigma)) * root2_sigma * std::sqrt(std::numbers::pi) *
         std::erf(w / root2_sigma);
}

double disc_line(const RemovalFunction& tif, double v) {
  const double radius = tif.radius, w = half_chord(radius, v);
  const double logarithm = v == 0.0 ? 0.0 : v * v * std::log((radius + w) / std::abs(v));
  return tif.slope * (radius * w + logarithm);
}

/// A curve over one grid row, read at y = 0.
TrackProfile profile_of(SplineSurface row) {
  const Grid& g = row.grid();
  const double low = g.x(-2), high = g.x(g.cols + 1);
  auto shared = std::make_shared<const SplineSurface>(std::move(row));
  return {[shared](double v) { return (*shared)({v, 0.0}); }, low, high};
}

/// The exact integral of a spline surface along one of its axes: a spline whose coefficients are the sums of the
/// surface's. `sign` turns the other axis into v.
TrackProfile sum_along_axis(const SplineSurface& surface, bool along_x, double sign) {
  const Grid& g = surface.grid();
  const Index count = along_x ? g.rows : g.cols;
  const double pitch = along_x ? g.pitch_y : g.pitch_x;
  const double first = along_x ? g.y(0) : g.x(0), last = along_x ? g.y(count - 1) : g.x(count - 1);
  const double scale = (along_x ? g.pitch_x : g.pitch_y) * 1.5;  // a lone row counts 2/3 at its own y
  std::vector<double> sums(static_cast<std::size_t>(count), 0.0);
  for (Index i = 0; i < g.size(); ++i) {
    const Index k = along_x ? i / g.cols : i % g.cols;
    sums[static_cast<std::size_t>(sign > 0.0 ? k : count - 1 - k)] +=
        scale * surface.coefficients()[static_cast<std::size_t>(i)];
  }
  const Grid row{1, count, pitch, 1.0, {sign > 0.0 ? first : -last, 0.0}};
  return profile_of(SplineSurface::with_coefficients(row, std::move(sums)));
}

/// Ends of the projection of the spline's support on a direction.
std::array<double, 2> projection(const Grid& g, Point direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double x : {g.x(-2), g.x(g.cols + 1)}) {
    for (const double y : {g.y(-2), g.y(g.rows + 1)}) {
      const double at = x * direction.x + y * direction.y;
      low = std::min(low, at);
      high = std::max(high, at);
    }
  }
  return {low, high};
}

TrackProfile integrate_obliquely(const SplineSurface& surface, Point along, Point across) {
  const Grid& g = surface.grid();
  const double step = kHalf * std::min(g.pitch_x, g.pitch_y);
  const auto [low, high] = projection(g, across);
  const auto [start, finish] = projection(g, along);
  const auto count = static_cast<Index>(std::ceil((high - low) / step)) + 1;
  const auto points = static_cast<Index>(std::ceil((finish - start) / step)) + 1;
  std::vector<double> table(static_cast<std::size_t>(count), 0.0);
  for (Index i = 0; i < count; ++i) {
    const Point foot = (low + step * static_cast<double>(i)) * across;
    double sum = 0.0;
    for (Index j = 0; j < points; ++j) sum += surface(foot + (start + step * static_cast<double>(j)) * along);
    table[static_cast<std::size_t>(i)] = sum * step;
  }
  return profile_of(SplineSurface(Grid{1, count, step, 1.0, {low, 0.0}}, table));
}

}  // namespace

TrackProfile line_profile(const RemovalFunction& tif, double angle_deg) {
  const Point along = checked_direction(angle_deg), across = left_of(along);
  const double radius = tif.radius;
  switch (tif.kind) {
    case RemovalFunction::Kind::Gaussian:
      return {[tif](double v) { return std::abs(v) <= tif.radius ? gaussian_line(tif, v) : 0.0; }, -radius, radius};
    case RemovalFunction::Kind::Disc:
      return {[tif](double v) { return std::abs(v) <= tif.radius ? disc_line(tif, v) : 0.0; }, -radius, radius};
    case RemovalFunction::Kind::Measured:
    case RemovalFunction::Kind::Model:
      break;
  }
  const SplineSurface surface(tif.samples.grid, tif.samples.values);
  if (along.y == 0.0) return sum_along_axis(surface, true, across.y);
  if (along.x == 0.0) return sum_along_axis(surface, false, across.x);
  return integrate_obliquely(surface, along, across);
}

TrackProfile axis_profile(const RemovalFunction& tif, double angle_deg) {
  const Point across = left_of(checked_direction(angle_deg));
  const double radius = tif.radius;
  switch (tif.kind) {
    case RemovalFunction::Kind::Gaussian:
      return {[tif](double v) {
                const double u = v / tif.sigma;
                return std::abs(v) <= tif.radius ? tif.peak * std::exp(-0.5 * u * u) : 0.0;
              },
              -radius, radius};
    case RemovalFunction::Kind::Disc:
      return {[tif](double v) { return std::abs(v) <= tif.radius ? tif.slope * std::abs(v) : 0.0; }, -radius, radius};
    case RemovalFunction::Kind::Measured:
    case RemovalFunction::Kind::Model:
      break;
  }
  auto surface = std::make_shared<const SplineSurface>(tif.samples.grid, tif.samples.values);
  const auto [low, high] = projection(surface->grid(), across);
  return {[surface, across](double v) { return (*surface)(v * across); }, low, high};
}

}  // namespace dwell
