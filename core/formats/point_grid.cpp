#include "core/formats/point_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/numerics/lattice_fit.h"

namespace dwell {
namespace {

constexpr double kPitchAgreement = 1e-3;  // a pitch typed with few digits (0.0938 for 0.09375 is 5e-4)

/// What tells a grid with gaps from scattered points: the share of its places that have a point; where that is less,
/// the share of points with another beside them in x and one in y. Fewer points than these tell nothing.
constexpr double kLeastFilled = 0.25, kLeastNeighboured = 0.5;
constexpr std::size_t kLeastToJudge = 9;

struct Direction {
  char letter;
  double Point::*coordinate;
};

constexpr Direction kX{'x', &Point::x};
constexpr Direction kY{'y', &Point::y};

Lattice lattice_of(const std::vector<XyzPoint>& points, Direction axis, const std::optional<Point>& pitch,
                   const std::optional<Point>& origin) {
  std::vector<double> coordinates(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) coordinates[i] = points[i].position.*axis.coordinate;
  if (!pitch) return fit_lattice(std::move(coordinates)).lattice;
  if (!origin) return fit_lattice(std::move(coordinates), *pitch.*axis.coordinate).lattice;
  Lattice known{*origin.*axis.coordinate, *pitch.*axis.coordinate, 1};
  known.count = known.nearest(*std::max_element(coordinates.begin(), coordinates.end())) + 1;
  return known;
}

void check_on_lattice(const std::vector<XyzPoint>& points, Direction axis, const Lattice& lattice,
                      const std::string& where, const std::string& name) {
  const XyzPoint* worst = &points.front();
  double worst_deviation = -1.0;
  for (const XyzPoint& point : points) {
    const double v = point.position.*axis.coordinate;
    const Index k = lattice.nearest(v);
    const double deviation = k < 0 || k >= lattice.count ? 1.0 : lattice.deviation(v);
    // Also true for NaN, so that an absurd coordinate cannot hide.
    if (!(deviation <= worst_deviation)) worst = &point, worst_deviation = deviation;
  }
  if (!(worst_deviation <= kLatticeTolerance)) {
    throw InputError(fmt::format(
        "{}, line {}: {} = {} mm is not on the regular grid {} + {} k (k = 0, 1, ...) of the "
        "other points; points of a regular grid are required, in any order, gaps allowed; or give `{} grid` "
        "pitch=MM if they are scattered",
        where, worst->line, axis.letter, worst->position.*axis.coordinate, lattice.origin, lattice.pitch, name));
  }
}

void check_agreement(const Lattice& lattice, Direction axis, const std::optional<Point>& pitch,
                     const std::optional<Point>& origin, const std::string& where, const std::string& name) {
  if (pitch && !(std::abs(*pitch.*axis.coordinate - lattice.pitch) <= kPitchAgreement * lattice.pitch)) {
    throw InputError(
        fmt::format("{}: its points have a pitch of {} mm in {}, but `{} pixel` or pitch_mm says {} mm; they "
                    "must agree (or be left out)",
                    where, lattice.pitch, axis.letter, name, *pitch.*axis.coordinate));
  }
  if (origin && !(std::abs(*origin.*axis.coordinate - lattice.origin) <= kLatticeTolerance * lattice.pitch)) {
    throw InputError(
        fmt::format("{}: its points begin at {} = {} mm, but `{} origin` or origin_mm says {} mm; they must "
                    "agree (or be left out)",
                    where, axis.letter, lattice.origin, name, *origin.*axis.coordinate));
  }
}

/// A stray point far away makes a grid of nothing but gaps.
void check_size(const Lattice& x, const Lattice& y, std::size_t points, const std::string& where,
                const std::string& name) {
  constexpr double kMostPixels = 1e6, kMostPixelsPerPoint = 100.0;
  const double pixels = static_cast<double>(x.count) * static_cast<double>(y.count);
  if (!(pixels <= std::max(kMostPixels, kMostPixelsPerPoint * static_cast<double>(points)))) {
    throw InputError(
        fmt::format("{}: {} make a grid of {} x {} pixels (pitch {} x {} mm); a grid of at most {} "
                    "pixels a point is accepted: look for a stray point, or give `{} grid` pitch=MM if the points are "
                    "scattered",
                    where, counted(points, "point"), y.count, x.count, x.pitch, y.pitch, kMostPixelsPerPoint, name));
  }
}

/// Scattered points with rounded coordinates lie on a grid as well, that of the last digit, and fill little of it. A
/// ring or a few lines fill little of their rectangle, but there the next place has a point too.
void check_filled(const Lattice& x, const Lattice& y, const std::vector<long>& line_of, std::size_t points,
                  const std::string& where, const std::string& name) {
  const double places = static_cast<double>(x.count) * static_cast<double>(y.count);
  const double filled = static_cast<double>(points) / places;
  if (points < kLeastToJudge || filled >= kLeastFilled) return;
  Index neighboured = 0;
  for (Index row = 0; row < y.count; ++row) {
    for (Index col = 0; col < x.count; ++col) {
      const auto at = static_cast<std::size_t>(row * x.count + col);
      if (line_of[at] == 0) continue;
      const bool beside =
          x.count == 1 || (col > 0 && line_of[at - 1] > 0) || (col + 1 < x.count && line_of[at + 1] > 0);
      const auto width = static_cast<std::size_t>(x.count);
      const bool above =
          y.count == 1 || (row > 0 && line_of[at - width] > 0) || (row + 1 < y.count && line_of[at + width] > 0);
      neighboured += beside && above ? 1 : 0;
    }
  }
  if (static_cast<double>(neighboured) >= kLeastNeighboured * static_cast<double>(points)) return;
  throw InputError(fmt::format(
      "{}: its {} fill {:.3g} % of a grid of {} x {} places (pitch {:.6g} x {:.6g} mm) and do not lie "
      "side by side on it; {:.0f} % are required of points of a regular grid. Give `{} grid` pitch=MM to fit "
      "a surface to scattered points",
      where, counted(points, "point"), 100.0 * filled, y.count, x.count, x.pitch, y.pitch, 100.0 * kLeastFilled, name));
}

}  // namespace

HeightMap grid_points(const std::vector<XyzPoint>& points, std::optional<Point> pitch, std::optional<Point> origin,
                      const std::string& where, const std::string& name, const PixelLimit& limit) {
  Lattice x = lattice_of(points, kX, pitch, origin), y = lattice_of(points, kY, pitch, origin);
  if (!(x.pitch > 0.0)) x.pitch = pitch ? pitch->x : y.pitch;
  if (!(y.pitch > 0.0)) y.pitch = pitch ? pitch->y : x.pitch;
  if (!(x.pitch > 0.0)) {
    throw InputError(fmt::format(
        "{}: all its points are at one place, which says no pixel pitch; give `{} pixel` [mm] > 0", where, name));
  }
  // With the pitches of the map: coordinates that were taken as one, being the same but for rounding, must also be so
  // on a borrowed pitch.
  check_on_lattice(points, kX, x, where, name);
  check_on_lattice(points, kY, y, where, name);
  check_size(x, y, points.size(), where, name);
  check_pixels(static_cast<double>(y.count), static_cast<double>(x.count), limit, where);
  check_agreement(x, kX, pitch, origin, where, name);
  check_agreement(y, kY, pitch, origin, where, name);

  HeightMap map(Grid{y.count, x.count, x.pitch, y.pitch, {x.origin, y.origin}});
  std::vector<long> line_of(map.values.size(), 0);
  for (const XyzPoint& point : points) {
    const auto pixel =
        static_cast<std::size_t>(map.grid.index(y.nearest(point.position.y), x.nearest(point.position.x)));
    if (line_of[pixel] > 0) {
      throw InputError(
          fmt::format("{}, line {}: point ({}, {}) mm was given in line {} already; once a point is accepted", where,
                      point.line, point.position.x, point.position.y, line_of[pixel]));
    }
    line_of[pixel] = point.line;
    map.values[pixel] = point.height;
  }
  check_filled(x, y, line_of, points.size(), where, name);
  return map;
}

}  // namespace dwell
