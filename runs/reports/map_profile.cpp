#include "runs/reports/map_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"
#include "runs/drawing/line_chart.h"

namespace dwell {
namespace {

constexpr double kMostSteps = 1e5;

[[noreturn]] void refuse(const Grid& g, const std::string& what) {
  throw InputError(
      fmt::format("profile {} does not lie on the map, which reaches from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) mm",
                  what, g.x(0) - 0.5 * g.pitch_x, g.y(0) - 0.5 * g.pitch_y, g.x(g.cols - 1) + 0.5 * g.pitch_x,
                  g.y(g.rows - 1) + 0.5 * g.pitch_y));
}

/// The pixel whose cell holds a place, or -1.
Index pixel_at(double place, double first, double pitch, Index count) {
  const double index = std::floor((place - first) / pitch + 0.5);
  if (index == static_cast<double>(count) &&
      place <= first + pitch * (static_cast<double>(count) - 0.5) * (1 + 1e-12)) {
    return count - 1;  // the outer edge of the last
  }
  return index >= 0.0 && index < static_cast<double>(count) ? static_cast<Index>(index) : -1;
}

/// Bilinear between the centres of pixels; within half a pixel of the edge as at the outermost centres.
double height_at(const HeightMap& map, Point p) {
  const Grid& g = map.grid;
  const double u = std::clamp((p.x - g.origin.x) / g.pitch_x, 0.0, static_cast<double>(g.cols - 1));
  const double v = std::clamp((p.y - g.origin.y) / g.pitch_y, 0.0, static_cast<double>(g.rows - 1));
  const Index col = std::min(static_cast<Index>(u), std::max<Index>(g.cols - 2, 0));
  const Index row = std::min(static_cast<Index>(v), std::max<Index>(g.rows - 2, 0));
  const double a = u - static_cast<double>(col), b = v - static_cast<double>(row);
  double sum = 0.0;
  for (const Index j : {Index{0}, Index{1}}) {
    for (const Index i : {Index{0}, Index{1}}) {
      const double weight = (i == 1 ? a : 1.0 - a) * (j == 1 ? b : 1.0 - b);
      if (weight > 0.0) sum += weight * map.at(row + j, col + i);  // NaN stays NaN; no weight, no pixel
    }
  }
  return sum;
}

MapProfile along_line(const HeightMap& map, const ProfileSpec& spec) {
  const Grid& g = map.grid;
  MapProfile profile{
      fmt::format("({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) mm", spec.from.x, spec.from.y, spec.to.x, spec.to.y),
      "distance",
      {},
      {}};
  for (const Point p : {spec.from, spec.to}) {
    if (pixel_at(p.x, g.origin.x, g.pitch_x, g.cols) < 0 || pixel_at(p.y, g.origin.y, g.pitch_y, g.rows) < 0) {
      refuse(g, profile.name);
    }
  }
  const double length = std::hypot(spec.to.x - spec.from.x, spec.to.y - spec.from.y);
  const auto steps = static_cast<Index>(std::min(std::ceil(length / std::min(g.pitch_x, g.pitch_y)), kMostSteps));
  for (Index k = 0; k <= steps; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(steps);
    profile.places.push_back(share * length);
    profile.heights.push_back(height_at(
        map, {spec.from.x + share * (spec.to.x - spec.from.x), spec.from.y + share * (spec.to.y - spec.from.y)}));
  }
  return profile;
}

MapProfile along_axis(const HeightMap& map, const ProfileSpec& spec) {
  const Grid& g = map.grid;
  const bool along_x = spec.kind == ProfileSpec::Kind::AlongX;
  const Index fixed =
      along_x ? pixel_at(spec.at, g.origin.y, g.pitch_y, g.rows) : pixel_at(spec.at, g.origin.x, g.pitch_x, g.cols);
  if (fixed < 0) refuse(g, fmt::format("{} = {:.6g} mm", along_x ? "y" : "x", spec.at));
  MapProfile profile{fmt::format("{} = {:.6g} mm", along_x ? "y" : "x", along_x ? g.y(fixed) : g.x(fixed)),
                     along_x ? "x" : "y",
                     {},
                     {}};
  for (Index k = 0; k < (along_x ? g.cols : g.rows); ++k) {
    profile.places.push_back(along_x ? g.x(k) : g.y(k));
    profile.heights.push_back(along_x ? map.at(fixed, k) : map.at(k, fixed));
  }
  return profile;
}

}  // namespace

double MapProfile::pv() const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double z : heights) {
    if (std::isfinite(z)) low = std::min(low, z), high = std::max(high, z);
  }
  return high - low;
}

double MapProfile::rms() const {
  double sum = 0.0, count = 0.0;
  for (const double z : heights) {
    if (std::isfinite(z)) sum += z, count += 1.0;
  }
  const double mean = sum / count;
  double square = 0.0;
  for (const double z : heights) {
    if (std::isfinite(z)) square += (z - mean) * (z - mean);
  }
  return std::sqrt(square / count);
}

ProfileSpec parse_profile_spec(const std::string& text) {
  ProfileSpec spec;
  const std::string_view word = trim(text);
  if (word.size() > 2 && (word.substr(0, 2) == "x=" || word.substr(0, 2) == "y=")) {
    spec.kind = word[0] == 'y' ? ProfileSpec::Kind::AlongX : ProfileSpec::Kind::AlongY;
    if (const auto at = finite_number(word.substr(2)); at && ranges::kPlace.holds(*at)) {
      spec.at = *at;
      return spec;
    }
  }
  const auto fields = split(text, ',');
  if (fields.size() == 4) {
    const auto x0 = finite_number(fields[0]), y0 = finite_number(fields[1]), x1 = finite_number(fields[2]),
               y1 = finite_number(fields[3]);
    const auto near = [](std::optional<double> v) { return v && ranges::kPlace.holds(*v); };
    if (near(x0) && near(y0) && near(x1) && near(y1) && (*x0 != *x1 || *y0 != *y1)) {
      return {ProfileSpec::Kind::Line, 0.0, {*x0, *y0}, {*x1, *y1}};
    }
  }
  throw InputError(fmt::format(
      "profile \"{}\"; accepted: y=MM (along x at this y), x=MM (along y at this x), or X0,Y0,X1,Y1 in mm (from one "
      "point to another), each {}",
      text, ranges::kPlace.text()));
}

MapProfile map_profile(const HeightMap& map, const ProfileSpec& spec) {
  MapProfile profile = spec.kind == ProfileSpec::Kind::Line ? along_line(map, spec) : along_axis(map, spec);
  if (std::none_of(profile.heights.begin(), profile.heights.end(), [](double z) { return std::isfinite(z); })) {
    throw InputError(fmt::format("profile {} meets no pixel that has data", profile.name));
  }
  return profile;
}

std::string profile_picture(const MapProfile& profile, const std::string& title, FigureFormat format) {
  ChartPanel panel{profile.position + " [mm]", "height [nm]", {}, AxisScale::Linear, AxisScale::Linear};
  ChartLine line{"", {33, 102, 172}, {}, false, false};
  for (std::size_t k = 0; k < profile.places.size(); ++k)
    line.points.push_back({profile.places[k], profile.heights[k], false});
  panel.lines.push_back(std::move(line));
  return draw_line_charts(title, "", {panel}, format);
}

}  // namespace dwell
