#include "paths/metrics/tool_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "paths/domain/point_limit.h"

namespace dwell {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
double angular_velocity(double rpm) { return 2.0 * std::numbers::pi * rpm / units::kSecondsPerMinute; }
Point polar(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

[[noreturn]] void refuse_texture(const char* option, double value, const char* unit, const std::string& required) {
  throw InputError(fmt::format("texture: {} = {}{}; required {}", option, value, unit, required));
}

void check_finite(const char* option, double value, const char* unit) {
  if (!std::isfinite(value)) refuse_texture(option, value, unit, "finite");
}

void check(const PlanetaryTool& tool, double step) {
  if (!(std::isfinite(tool.revolution_radius) && tool.revolution_radius >= 0.0)) {
    refuse_texture("revolution_radius", tool.revolution_radius, " mm", "finite and >= 0");
  }
  if (!(std::isfinite(tool.tool_radius) && tool.tool_radius > 0.0)) {
    refuse_texture("tool_radius", tool.tool_radius, " mm", "finite and > 0");
  }
  if (!(tool.point_radius >= 0.0 && tool.point_radius <= tool.tool_radius)) {
    refuse_texture("point_radius", tool.point_radius, " mm",
                   fmt::format(">= 0 and <= tool_radius = {} mm", tool.tool_radius));
  }
  check_finite("revolution_rpm", tool.revolution_rpm, "");
  check_finite("spin_rpm", tool.spin_rpm, "");
  check_finite("revolution_deg", tool.revolution_deg, "");
  check_finite("spin_deg", tool.spin_deg, "");
  if (!(std::isfinite(step) && step > 0.0)) refuse_texture("step", step, " s", "finite and > 0");
  const double fastest =
      std::max(std::abs(tool.revolution_rpm), std::abs(tool.revolution_rpm + tool.spin_rpm)) / units::kSecondsPerMinute;
  if (!(fastest * step <= 0.125 * (1.0 + 1e-9))) {
    refuse_texture(
        "step", step, " s",
        fmt::format("<= {:.6g} s, an eighth of a turn of what turns fastest over the part", 0.125 / fastest));
  }
}

/// Where O1 is after the share f of a stroke's length.
Point along(const Stroke& stroke, double f) {
  const double first = distance(stroke.start, stroke.via), total = stroke.length();
  if (!(total > 0.0)) return stroke.via;
  const double s = f * total;
  if (s <= first && first > 0.0) return stroke.start + (s / first) * (stroke.via - stroke.start);
  return stroke.via + ((s - first) / (total - first)) * (stroke.finish - stroke.via);
}

}  // namespace

Point PlanetaryTool::offset(double t) const {
  const double phi = radians(revolution_deg) + angular_velocity(revolution_rpm) * t;
  const double beta = radians(spin_deg) + angular_velocity(spin_rpm) * t;
  return polar(revolution_radius, phi) - polar(point_radius, phi + beta);
}

double PlanetaryTool::speed(double t) const {
  const double beta = radians(spin_deg) + angular_velocity(spin_rpm) * t;
  const double r0 = revolution_radius, r1 = point_radius;
  const double v2 = angular_velocity(spin_rpm) * r1;
  const double r = std::sqrt(std::max(r0 * r0 + r1 * r1 - 2.0 * r0 * r1 * std::cos(beta), 0.0));
  const double v1 = angular_velocity(revolution_rpm) * r;
  if (!(r > 0.0)) return std::abs(v2);
  // r cos(pi - beta - theta) is the projection of O1 A on O2 A.
  const double cosine = (r1 - r0 * std::cos(beta)) / r;
  return std::sqrt(std::max(v1 * v1 + v2 * v2 + 2.0 * v1 * v2 * cosine, 0.0));
}

TextureTrack texture_track(const std::vector<Stroke>& strokes, const Eigen::VectorXd& times, const PlanetaryTool& tool,
                           double step) {
  check(tool, step);
  if (times.size() != static_cast<Index>(strokes.size())) {
    throw InputError(
        fmt::format("texture: {} for {} strokes; required one each", counted(times.size(), "time"), strokes.size()));
  }
  double total = 0.0;
  for (Index j = 0; j < times.size(); ++j) {
    if (!(std::isfinite(times[j]) && times[j] >= 0.0)) {
      throw InputError(fmt::format("texture: time of stroke {} = {} s; required finite and >= 0", j + 1, times[j]));
    }
    total += times[j];
  }
  if (!(total / step < kMaxPathPoints)) {
    refuse_texture("step", step, " s",
                   fmt::format("> {:.6g} s: the run takes {:.6g} s, at most 50 million points of the track",
                               total / kMaxPathPoints, total));
  }
  TextureTrack track;
  track.step = step;
  track.points.reserve(static_cast<std::size_t>(total / step) + 2);
  double begin = 0.0;
  std::size_t next = 0;  // point of the track; its time is the product, so that rounding does not add up
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    const double time = times[static_cast<Index>(j)], end = begin + time;
    for (;; ++next) {
      const double t = static_cast<double>(next) * step;
      if (!(t < end)) break;
      track.points.push_back(along(strokes[j], (t - begin) / time) + tool.offset(t));
    }
    begin = end;
  }
  return track;
}

HeightMap texture_density(const TextureTrack& track, const Grid& grid) {
  HeightMap density(grid);
  std::fill(density.values.begin(), density.values.end(), 0.0);
  const double share = track.step / (grid.pitch_x * grid.pitch_y);
  for (const Point p : track.points) {
    const double u = (p.x - grid.origin.x) / grid.pitch_x, v = (p.y - grid.origin.y) / grid.pitch_y;
    const double fu = std::floor(u), fv = std::floor(v);
    if (!(fu >= -1.0 && fu < static_cast<double>(grid.cols) && fv >= -1.0 && fv < static_cast<double>(grid.rows))) {
      continue;
    }
    const auto col = static_cast<Index>(fu), row = static_cast<Index>(fv);
    for (const auto& [r, wy] : {std::pair{row, 1.0 - (v - fv)}, std::pair{row + 1, v - fv}}) {
      if (r < 0 || r >= grid.rows) continue;
      for (const auto& [c, wx] : {std::pair{col, 1.0 - (u - fu)}, std::pair{col + 1, u - fu}}) {
        if (c >= 0 && c < grid.cols) density.at(r, c) += share * wy * wx;
      }
    }
  }
  return density;
}

}  // namespace dwell
