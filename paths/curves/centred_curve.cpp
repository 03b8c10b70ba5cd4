#include "paths/curves/centred_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "paths/domain/point_limit.h"

namespace dwell {
namespace {

double checked_length(double value, const char* planner, const char* option) {
  if (std::isfinite(value) && value > 0.0) return value;
  throw InputError(fmt::format("{}: {} = {} mm; required {}", planner, option, value, value > 0.0 ? "finite" : "> 0"));
}

double checked_overrun(double value, const char* planner) {
  if (std::isfinite(value) && value >= 0.0) return value;
  throw InputError(fmt::format("{}: overrun = {} mm; required finite and >= 0", planner, value));
}

Point checked_centre(const std::optional<Point>& centre, const PathDomain& domain, const char* planner) {
  const Point p = centre.value_or(domain.middle());
  if (std::isfinite(p.x) && std::isfinite(p.y)) return p;
  throw InputError(fmt::format("{}: centre = {}/{} mm; required finite", planner, p.x, p.y));
}

}  // namespace

CentredCurveOptions parse_centred_curve(const SpecText& spec) {
  spec.accept_only({"pitch", "step", "overrun", "centre", "from", "turn"});
  CentredCurveOptions options;
  options.pitch = spec.number("pitch");
  options.step = spec.optional_number("step");
  options.overrun = spec.optional_number("overrun");
  options.centre = spec.optional_point("centre");
  options.from_edge = spec.choice("from", {"centre", "edge"}) == "edge";
  options.clockwise = spec.choice("turn", {"ccw", "cw"}) == "cw";
  return options;
}

CentredDomain::CentredDomain(const HeightMap& map, const CentredCurveOptions& options, double longest_step,
                             const char* planner, const Progress& progress)
    : pitch(checked_length(options.pitch, planner, "pitch")),
      step(checked_length(options.step.value_or(options.pitch), planner, "step")),
      domain(map,
             std::max({checked_overrun(options.overrun.value_or(0.0), planner), 0.5 * (pitch + longest_step * step),
                       0.5 * std::hypot(map.grid.pitch_x, map.grid.pitch_y)}),
             planner, "overrun", progress) {
  centre = checked_centre(options.centre, domain, planner);
  radius = radial_range(map, centre, domain.reach());
}

void CentredDomain::check_size(double points, const char* planner) const {
  if (points <= kMaxPathPoints) return;
  throw InputError(
      fmt::format("{}: pitch = {} mm and step = {} mm make {:.3g} points from {:.6g} to {:.6g} mm from the centre; at "
                  "most {:.0e} accepted, make pitch or step larger",
                  planner, pitch, step, std::isnan(points) ? std::numeric_limits<double>::infinity() : points,
                  radius.low, radius.high, kMaxPathPoints));
}

std::size_t CentredDomain::about_points(double points) const {
  const Point size = domain.box().high - domain.box().low;
  const double reach = 2.0 * (domain.reach() + pitch);
  return static_cast<std::size_t>(std::min(points, (size.x + reach) * (size.y + reach) / (pitch * step)));
}

Interval radial_range(const HeightMap& map, Point centre, double reach) {
  Interval squared;
  const Grid& grid = map.grid;
  for (Index row = 0; row < grid.rows; ++row) {
    for (Index col = 0; col < grid.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      const Point p = grid.centre(row, col) - centre;
      squared.include(p.x * p.x + p.y * p.y);
    }
  }
  const double rounding = 1e-9 * std::min(grid.pitch_x, grid.pitch_y);
  return {std::max(std::sqrt(squared.low) - reach - rounding, 0.0), std::sqrt(squared.high) + reach + rounding};
}

void reverse(ToolPath& path) {
  std::reverse(path.points.begin(), path.points.end());
  // The move into point j is, backwards, the move into point j - 1.
  std::reverse(path.lifted.begin(), path.lifted.end());
  if (path.lifted.empty()) return;
  std::rotate(path.lifted.begin(), path.lifted.end() - 1, path.lifted.end());
  path.lifted.front() = 1;
}

}  // namespace dwell
