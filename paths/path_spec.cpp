#include "paths/path_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/spec_text.h"
#include "paths/domain/distance_map.h"
#include "paths/feed/depth_feed.h"
#include "paths/metrics/track_overlap.h"
#include "paths/metrics/track_profile.h"
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

void check_distance(const char* option, double value, const PathJob& job) {
  const double width = 2.0 * job.tif.radius;
  if (!(value > width)) return;  // whatever else is wrong with it, the planner says
  throw InputError(fmt::format(
      "path: {} = {:.6g} mm; required at most {:.6g} mm, the removal function's diameter: farther apart, there are "
      "places that the tool never touches",
      option, value, width));
}

/// Refuses tracks or dwell points farther apart than the tool is wide.
template <class Options>
void check_distances(const Options& o, const PathJob& job) {
  if constexpr (requires { o.pitch; }) check_distance("pitch", o.pitch, job);
  if constexpr (requires { o.lattice; }) check_distance("pitch", o.lattice.pitch, job);
  if constexpr (requires { o.cell; }) check_distance("cell", o.cell, job);
  if constexpr (requires { *o.step; }) check_distance("step", o.step.value_or(0.0), job);
  if constexpr (requires { *o.min_pitch; }) check_distance("min-pitch", o.min_pitch.value_or(0.0), job);
  if constexpr (requires { *o.max_pitch; }) check_distance("max-pitch", o.max_pitch.value_or(0.0), job);
  if constexpr (requires { o.pitches; }) {
    for (const double pitch : o.pitches) check_distance("pitches", pitch, job);
  }
}

/// Says of moves over the part that are longer than the tool is wide and made with it down.
void note_long_moves(ToolPath& path, const PathJob& job) {
  const double width = 2.0 * job.tif.radius;
  Index moves = 0;
  double longest = 0.0;
  for (std::size_t j = 1; j < path.size(); ++j) {
    const double move = path.lifted[j] ? 0.0 : distance(path.points[j - 1], path.points[j]);
    if (move > width) ++moves;
    longest = std::max(longest, move);
  }
  if (moves == 0) return;
  path.notes.push_back(
      fmt::format("{} moves are longer than the removal function is wide and made with the tool down, "
                  "the longest {:.4g} mm: they remove where they pass",
                  moves, longest));
}

ToolPath planned(RasterOptions options, const PathJob& job) {
  if (!options.overrun) options.overrun = job.tif.radius;
  if (!options.auto_pitch) return raster_path(job.target, options);
  const double size = 2.0 * job.tif.radius;
  const AutoPitch chosen = widest_pitch(line_profile(job.tif, options.angle_deg), size, options.ripple);
  options.pitch = chosen.ripple.pitch;
  ToolPath path = raster_path(job.target, options);
  path.notes.push_back(fmt::format(
      "pitch {:.4g} mm, chosen as the widest that leaves a ripple of at most {:.3g} % of the removal: {:.3g} % peak to "
      "valley, tracks overlapping by {:.3g} %, deviation of their sum {:.2g} of one track's peak",
      options.pitch, 100.0 * options.ripple, 100.0 * chosen.ripple.pvn, 100.0 * chosen.track.overlap,
      chosen.track.deviation));
  return path;
}

ToolPath planned(const MultiPitchOptions& options, const PathJob& job) {
  MultiPitchPath planned = multi_pitch_path(job.target, job.tif, job.max_feed, options);
  if (!job.estimates) return std::move(planned.path);
  const DepthFeedJob by_depth{job.tif.volume, planned.lowest, job.max_feed, planned.step};
  const DepthFeed cheap = depth_feed(job.target, planned.path, planned.pitch_of_points(), by_depth);
  planned.path.notes.push_back(
      fmt::format("by the depth at each point alone (Hou et al. 2017, eq. 12) the dwell would be {:.5g} s, {} of {} "
                  "points at the fastest feed",
                  cheap.total_seconds, cheap.limited, planned.path.size()));
  return std::move(planned.path);
}

/// The planners that need nothing of the tool but how far to go beyond the part.
template <class Options>
ToolPath with_overrun(Options options, const PathJob& job, ToolPath (*plan)(const HeightMap&, const Options&)) {
  if (!options.overrun) options.overrun = job.tif.radius;
  return plan(job.target, options);
}

ToolPath planned(const CrossHatchOptions& o, const PathJob& job) { return with_overrun(o, job, cross_hatch_path); }
ToolPath planned(const RandomRasterOptions& o, const PathJob& job) { return with_overrun(o, job, random_raster_path); }
ToolPath planned(const SpiralOptions& o, const PathJob& job) { return with_overrun(o, job, spiral_path); }
ToolPath planned(const CirclesOptions& o, const PathJob& job) { return with_overrun(o, job, circles_path); }
ToolPath planned(const FibonacciOptions& o, const PathJob& job) { return with_overrun(o, job, fibonacci_path); }

ToolPath planned(NearestOptions options, const PathJob& job) {
  options.stop = job.stop;
  return nearest_path(job.target, options).path;
}

template <class Options>
Options with_lattice_overrun(Options options, const PathJob& job) {
  if (!options.lattice.overrun) options.lattice.overrun = job.tif.radius;
  return options;
}

ToolPath planned(const RandomOptions& o, const PathJob& job) {
  return random_path(job.target, with_lattice_overrun(o, job)).path;
}
ToolPath planned(const HilbertOptions& o, const PathJob& job) {
  return hilbert_path(job.target, with_lattice_overrun(o, job));
}
ToolPath planned(const PeanoOptions& o, const PathJob& job) {
  return peano_path(job.target, with_lattice_overrun(o, job));
}

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
      {{"raster",
        "pitch=MM|auto[,ripple=SHARE][,step=MM][,angle=DEGREES][,overrun=MM][,order=serpentine|one-way][,turn=square|"
        "arc|lift][,corner=MM]",
        "straight lines"},
       [](const SpecText& spec) -> PathSpec { return parse_raster_options(spec); }},
      {{"cross-hatch",
        "pitch=MM[,step=MM][,angle=DEGREES][,crossing=DEGREES][,overrun=MM][,turn=square|arc|lift][,corner=MM]",
        "two rasters that cross, one after the other"},
       [](const SpecText& spec) -> PathSpec { return parse_cross_hatch_options(spec); }},
      {{"random-raster",
        "pitch=MM[,spread=MM|N%][,step=MM][,angle=DEGREES][,overrun=MM][,order=serpentine|one-way]"
        "[,turn=square|arc|lift][,corner=MM][,seed=N]",
        "straight lines at random distances about the pitch"},
       [](const SpecText& spec) -> PathSpec { return parse_random_raster_options(spec); }},
      {{"spiral", "pitch=MM[,step=MM][,overrun=MM][,centre=X/Y][,from=centre|edge][,turn=ccw|cw]",
        "Archimedean spiral, dwell points at equal arc lengths"},
       [](const SpecText& spec) -> PathSpec { return parse_spiral_options(spec); }},
      {{"circles", "pitch=MM[,step=MM][,overrun=MM][,centre=X/Y][,from=centre|edge][,turn=ccw|cw]",
        "concentric circles"},
       [](const SpecText& spec) -> PathSpec { return parse_circles_options(spec); }},
      {{"fibonacci", "pitch=MM[,overrun=MM][,centre=X/Y]", "phyllotaxis lattice, along its spiral arms"},
       [](const SpecText& spec) -> PathSpec { return parse_fibonacci_options(spec); }},
      {{"nearest", "cell=MM[,critical=NM][,lift=CELLS|inf][,start=X/Y][,improve=none|2opt]",
        "from cell to nearest cell, only where the map is above the critical value", "cell"},
       [](const SpecText& spec) -> PathSpec { return parse_nearest_options(spec); }},
      {{"random", "pitch=MM[,overrun=MM][,angle=DEGREES][,seed=N]",
        "pseudo-random: through every point of a square lattice once, from neighbour to neighbour"},
       [](const SpecText& spec) -> PathSpec { return parse_random_options(spec); }},
      {{"hilbert", "pitch=MM[,overrun=MM][,angle=DEGREES][,gaps=link|lift]", "Hilbert's curve over a square lattice"},
       [](const SpecText& spec) -> PathSpec { return parse_hilbert_options(spec); }},
      {{"peano", "pitch=MM[,overrun=MM][,angle=DEGREES][,gaps=link|lift]", "Peano's curve over a square lattice"},
       [](const SpecText& spec) -> PathSpec { return parse_peano_options(spec); }},
      {{"multi-pitch",
        "[ranges=N][,pitches=MM/MM/...][,depths=NM/NM/...][,min-pitch=MM][,max-pitch=MM][,step=MM][,angle=DEGREES]"
        "[,overrun=MM][,lift=PITCHES|inf][,smooth=MM]",
        "straight lines, closer together where more is to be removed", ""},
       [](const SpecText& spec) -> PathSpec { return parse_multi_pitch_options(spec); }},
      {{"file", "PATH.csv", "dwell points in the order of a file", ""}, parse_file},
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
  ToolPath path = std::visit(
      [&](const auto& options) {
        check_distances(options, job);
        return planned(options, job);
      },
      spec);
  note_long_moves(path, job);
  return path;
}

}  // namespace dwell
