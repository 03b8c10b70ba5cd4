#include "paths/path_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.h"
#include "core/spec_text.h"
#include "paths/distance_map.h"
#include "paths/path_file.h"

namespace dwell {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(fmt::format("path \"{}\": {}", text, why));
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

ToolPath planned(RasterOptions options, const PathJob& job) {
  if (!options.overrun) options.overrun = job.tif.radius;
  return raster_path(job.target, options);
}

ToolPath planned(const NearestOptions& options, const PathJob& job) { return nearest_path(job.target, options).path; }

ToolPath planned(const PathFromFile& spec, const PathJob& job) {
  ToolPath path = read_path_file(spec.file);
  refuse_outside(path, job.target, job.tif.radius, spec.file.string());
  return path;
}

PathSpec parse_file(const SpecText& spec) {
  const std::string file = split_kind(spec.text).second;
  if (file.empty()) refuse(spec.text, "the name of a file is missing; required: file:PATH.csv");
  return PathFromFile{file};
}

struct KnownKind {
  PathKind kind;
  PathSpec (*parse)(const SpecText&);
};

const std::vector<KnownKind>& known_kinds() {
  static const std::vector<KnownKind> kinds{
      {{"raster", "pitch=MM[,step=MM][,angle=DEGREES][,overrun=MM][,order=serpentine|one-way]", "straight lines"},
       [](const SpecText& spec) -> PathSpec { return parse_raster_options(spec); }},
      {{"nearest", "cell=MM[,critical=NM][,lift=CELLS|inf][,start=X/Y][,improve=none|2opt]",
        "from cell to nearest cell, only where the map is above the critical value"},
       [](const SpecText& spec) -> PathSpec { return parse_nearest_options(spec); }},
      {{"file", "PATH.csv", "dwell points in the order of a file"}, parse_file},
  };
  return kinds;
}

std::vector<PathKind> kinds_alone() {
  std::vector<PathKind> kinds;
  for (const KnownKind& known : known_kinds()) kinds.push_back(known.kind);
  return kinds;
}

/// "file:PATH.csv" is not cut at commas: a name may hold any.
SpecText spec_text_of(const std::string& text) {
  const auto [kind, rest] = split_kind(text);
  return kind == "file" ? SpecText{"path", text, kind, {}} : parse_spec_text(text, "path");
}

}  // namespace

const std::vector<PathKind>& path_kinds() {
  static const std::vector<PathKind> kinds = kinds_alone();
  return kinds;
}

PathSpec parse_path_spec(const std::string& text) {
  const SpecText spec = spec_text_of(text);
  std::string accepted;
  for (const KnownKind& known : known_kinds()) {
    if (known.kind.name == spec.kind) return known.parse(spec);
    accepted += (accepted.empty() ? "" : ", ") + known.kind.name;
  }
  refuse(text, fmt::format("unknown kind \"{}\"; accepted: {}", spec.kind, accepted));
}

ToolPath plan_path(const PathSpec& spec, const PathJob& job) {
  return std::visit([&](const auto& options) { return planned(options, job); }, spec);
}

}  // namespace dwell
