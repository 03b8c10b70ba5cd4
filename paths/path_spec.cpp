#include "paths/path_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/errors.h"
#include "core/number_text.h"
#include "core/spec_text.h"
#include "paths/distance_map.h"
#include "paths/path_file.h"

namespace dwell {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(fmt::format("path \"{}\": {}", text, why));
}

RasterOptions parse_raster(const SpecText& spec) {
  spec.accept_only({"pitch", "step", "angle", "overrun", "order"});
  RasterOptions options;
  options.pitch = spec.number("pitch");
  options.step = spec.optional_number("step");
  options.angle_deg = spec.number("angle", options.angle_deg);
  options.overrun = spec.optional_number("overrun");
  const std::string order = spec.word("order").value_or("serpentine");
  if (order != "serpentine" && order != "one-way") {
    refuse(spec.text, fmt::format("order = \"{}\"; accepted: serpentine, one-way", order));
  }
  options.serpentine = order == "serpentine";
  return options;
}

std::optional<Point> parse_start(const SpecText& spec) {
  const std::optional<std::string> text = spec.word("start");
  if (!text) return std::nullopt;
  const std::size_t slash = text->find('/');
  if (slash != std::string::npos) {
    const std::optional<double> x = parse_number(text->substr(0, slash));
    const std::optional<double> y = parse_number(text->substr(slash + 1));
    if (x && y) return Point{*x, *y};
  }
  refuse(spec.text, fmt::format("start = \"{}\"; required X/Y in mm, for instance start=-10/2.5", *text));
}

NearestOptions parse_nearest(const SpecText& spec) {
  spec.accept_only({"cell", "critical", "lift", "start"});
  NearestOptions options;
  options.cell = spec.number("cell");
  options.critical = spec.number("critical", options.critical);
  options.lift = spec.number("lift", options.lift);
  options.start = parse_start(spec);
  return options;
}

std::string span(double low, double high) { return fmt::format("{:.6g} to {:.6g}", low, high); }

/// A stroke ends within half a move of its dwell point, so a path refused here removes nothing from the part.
void refuse_outside(const ToolPath& path, const HeightMap& target, double tif_radius, const std::string& file) {
  const double reach = tif_radius * std::numbers::sqrt2;  // the TIF's support is a square of half-width tif_radius
  const DistanceMap distance_to_part(target, reach);
  const std::vector<Stroke> strokes = moving_strokes(path);
  const bool on_part = std::any_of(strokes.begin(), strokes.end(), [&](const Stroke& stroke) {
    return distance_to_part.within(stroke.via, reach + stroke.length());
  });
  if (on_part) return;
  Point low = path.points[0], high = path.points[0];
  for (const Point p : path.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Grid& g = target.grid;
  throw InputError(fmt::format(
      "{}: the path lies wholly outside the part: its points have x {} and y {} mm, the map x {} and y {} mm, and "
      "the removal function reaches {:.6g} mm; required: a path in the map's coordinates",
      file, span(low.x, high.x), span(low.y, high.y), span(g.x(0), g.x(g.cols - 1)), span(g.y(0), g.y(g.rows - 1)),
      tif_radius));
}

struct Planner {
  const HeightMap& target;
  double tif_radius;

  ToolPath operator()(RasterOptions options) const {
    if (!options.overrun) options.overrun = tif_radius;
    return raster_path(target, options);
  }
  ToolPath operator()(const NearestOptions& options) const { return nearest_path(target, options).path; }
  ToolPath operator()(const PathFromFile& spec) const {
    ToolPath path = read_path_file(spec.file);
    refuse_outside(path, target, tif_radius, spec.file.string());
    return path;
  }
};

}  // namespace

PathSpec parse_path_spec(const std::string& text) {
  const auto [kind, rest] = split_kind(text);
  if (kind == "file") {
    if (rest.empty()) refuse(text, "the name of a file is missing; required: file:PATH.csv");
    return PathFromFile{rest};
  }
  const SpecText spec = parse_spec_text(text, "path");
  if (spec.kind == "raster") return parse_raster(spec);
  if (spec.kind == "nearest") return parse_nearest(spec);
  refuse(text,
         fmt::format("unknown kind \"{}\"; accepted: raster:pitch=MM, nearest:cell=MM, file:PATH.csv", spec.kind));
}

ToolPath plan_path(const PathSpec& spec, const HeightMap& target, double tif_radius) {
  if (!(std::isfinite(tif_radius) && tif_radius > 0.0)) {
    throw InputError(fmt::format("path: radius of the removal function = {} mm; required finite and > 0", tif_radius));
  }
  return std::visit(Planner{target, tif_radius}, spec);
}

}  // namespace dwell
