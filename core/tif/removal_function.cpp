#include "core/tif/removal_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/grid_limit.h"
#include "core/base/value_range.h"
#include "core/tif/removal_apex.h"

namespace dwell {
namespace {

void require_within(double value, const char* name, const ValueRange& range) {
  if (range.holds(value)) return;
  throw InputError(fmt::format("removal function: {} = {} {}; required {}", name, value, range.unit, range.text()));
}

Point centroid(const HeightMap& rates) {
  double sum = 0.0;
  Point moment;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const double v = rates.values[static_cast<std::size_t>(i)];
    sum += v;
    moment = moment + v * rates.grid.centre(i);
  }
  if (!(sum > 0.0)) {
    throw InputError(
        fmt::format("removal function: its samples sum to {} nm/s; the centroid needs a positive sum "
                    "(use `tif centre` middle or x,y)",
                    sum));
  }
  return (1.0 / sum) * moment;
}

Point top_of(const HeightMap& rates) {
  const Grid& g = rates.grid;
  const double peak = *std::max_element(rates.values.begin(), rates.values.end());
  if (const auto found = rounded_apex(rates, peak, middle_of(g), std::hypot(g.width(), g.height()))) return *found;
  throw InputError(
      "removal function: `tif centre` peak: its top is not rounded (a ring, several peaks, or noise), or has fewer "
      "than "
      "9 samples above 70 % of the peak; accepted: middle, centroid or x,y");
}

Point axis_of(const HeightMap& rates, const TifCentre& centre) {
  switch (centre.kind) {
    case TifCentre::Kind::Centroid:
      return centroid(rates);
    case TifCentre::Kind::Peak:
      return top_of(rates);
    case TifCentre::Kind::Given:
      return centre.given;
    case TifCentre::Kind::Middle:
      break;
  }
  return middle_of(rates.grid);
}

/// Half the side of the smallest square about the axis that holds every sample which is not zero [mm].
double reach(const HeightMap& rates) {
  double radius = 0.0;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    if (rates.values[static_cast<std::size_t>(i)] == 0.0) continue;
    const Point p = rates.grid.centre(i);
    radius = std::max({radius, std::abs(p.x), std::abs(p.y)});
  }
  return radius;
}

}  // namespace

RemovalFunction gaussian_removal(double peak, double fwhm, double radius) {
  require_within(peak, "peak", ranges::kRate);
  require_within(fwhm, "fwhm", ranges::kSize);
  require_within(radius, "radius", ranges::kSize);
  RemovalFunction tif;
  tif.kind = RemovalFunction::Kind::Gaussian;
  tif.peak = peak;
  tif.fwhm = fwhm;
  tif.radius = radius;
  tif.sigma = fwhm / std::sqrt(8.0 * std::numbers::ln2);
  const double q = radius / tif.sigma;
  tif.volume = 2.0 * std::numbers::pi * tif.sigma * tif.sigma * peak * -std::expm1(-0.5 * q * q);
  return tif;
}

RemovalFunction spinning_disc_removal(double slope, double radius) {
  require_within(radius, "radius", ranges::kSize);
  if (!(std::isfinite(slope) && slope > 0.0)) {
    throw InputError(fmt::format("removal function: slope = {} nm/s/mm; required finite and > 0", slope));
  }
  require_within(slope * radius, "slope x radius, its fastest removal,", ranges::kRate);
  RemovalFunction tif;
  tif.kind = RemovalFunction::Kind::Disc;
  tif.slope = slope;
  tif.radius = radius;
  tif.peak = slope * radius;
  tif.volume = 2.0 * std::numbers::pi / 3.0 * slope * radius * radius * radius;
  tif.fwhm = std::sqrt(3.0) * radius;  // the ring R/2 <= r <= R has the area of a disc of diameter sqrt(3) R
  return tif;
}

RemovalFunction measured_removal(const HeightMap& rates, const TifCentre& centre) {
  RemovalFunction tif;
  tif.kind = RemovalFunction::Kind::Measured;
  tif.samples = rates;
  for (double& v : tif.samples.values) {
    if (!std::isfinite(v)) v = 0.0;
  }
  const auto& values = tif.samples.values;
  tif.peak = *std::max_element(values.begin(), values.end());
  if (!(tif.peak > 0.0)) {
    throw InputError(
        fmt::format("removal function: its largest rate is {} nm/s; at least one sample must be > 0", tif.peak));
  }
  require_within(tif.peak, "its largest rate", ranges::kRate);
  const double lowest = *std::min_element(values.begin(), values.end());
  require_within(std::max(tif.peak, -lowest), "its largest negative rate, without its sign,", ranges::kRate);
  Grid& grid = tif.samples.grid;
  grid.origin = grid.origin - axis_of(tif.samples, centre);
  const double cell = grid.pitch_x * grid.pitch_y;
  double above_half = 0.0;
  for (double v : values) {
    tif.volume += v * cell;
    if (v >= 0.5 * tif.peak) above_half += cell;
  }
  if (!(tif.volume > 0.0)) {
    throw InputError(fmt::format("removal function: its volume rate is {} nm mm^2/s; must be > 0", tif.volume));
  }
  tif.fwhm = 2.0 * std::sqrt(above_half / std::numbers::pi);
  tif.radius = reach(tif.samples);
  return tif;
}

std::string kind_of(const RemovalFunction& tif) {
  switch (tif.kind) {
    case RemovalFunction::Kind::Gaussian:
      return "gaussian";
    case RemovalFunction::Kind::Disc:
      return "disc";
    case RemovalFunction::Kind::Measured:
      return "measured";
    case RemovalFunction::Kind::Model:
      return tif.model;
  }
  return "unknown";
}

}  // namespace dwell
