#include "paths/path_catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "core/map/part_distance.h"
#include "paths/curves/circles.h"
#include "paths/curves/fibonacci.h"
#include "paths/curves/spiral.h"
#include "paths/domain/distance_map.h"
#include "paths/feed/depth_feed.h"
#include "paths/lattice/hilbert.h"
#include "paths/lattice/peano.h"
#include "paths/lattice/random_path.h"
#include "paths/lines/cross_hatch.h"
#include "paths/lines/line_path.h"
#include "paths/lines/multi_pitch.h"
#include "paths/lines/random_raster.h"
#include "paths/lines/raster.h"
#include "paths/metrics/track_overlap.h"
#include "paths/metrics/track_profile.h"
#include "paths/path_file.h"
#include "paths/tours/nearest_neighbour.h"

namespace dwell {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError(fmt::format("path \"{}\": {}", text, why));
}

std::string span(double low, double high) { return fmt::format("{:.6g} to {:.6g}", low, high); }

/// A stroke ends within half a move of its dwell point, so a path refused here removes nothing from the part.
void refuse_outside(const ToolPath& path, const PathJob& job, const std::string& file) {
  const HeightMap& target = job.target;
  const double tif_radius = job.tif.radius;
  const double reach = tif_radius * std::numbers::sqrt2;  // the TIF's support is a square of half-width tif_radius
  const DistanceMap distance_to_part(target, reach, job.progress);
  Poll poll(job.progress);
  const std::vector<Stroke> strokes = moving_strokes(path);
  const bool on_part = std::any_of(strokes.begin(), strokes.end(), [&](const Stroke& stroke) {
    poll.step();
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

/// Refuses tracks or dwell points farther apart than the tool is wide.
void check_distance(const PathDistance& distance, const PathJob& job) {
  const double width = 2.0 * job.tif.radius;
  if (!(distance.value > width)) return;  // the planner itself reports other faults of the value
  throw InputError(fmt::format(
      "path: {} = {:.6g} mm; required at most {:.6g} mm, the removal function's diameter: farther apart, there are "
      "places that the tool never touches",
      distance.option, distance.value, width));
}

/// A note about moves over the part that are longer than the tool is wide and made with it down.
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
      moves == 1 ? fmt::format("1 move is longer than the removal function is wide and made with the tool down, "
                               "{:.4g} mm: it removes where it passes",
                               longest)
                 : fmt::format("{} moves are longer than the removal function is wide and made with the tool down, "
                               "the longest {:.4g} mm: they remove where they pass",
                               moves, longest));
}

ToolPath plan_raster(RasterOptions options, const PathJob& job) {
  if (!options.overrun) options.overrun = job.tif.radius;
  if (!options.auto_pitch) return raster_path(job.target, options, job.progress);
  const double size = 2.0 * job.tif.radius;
  const AutoPitch chosen = widest_pitch(line_profile(job.tif, options.angle_deg), size, options.ripple);
  options.pitch = chosen.ripple.pitch;
  ToolPath path = raster_path(job.target, options, job.progress);
  path.notes.push_back(fmt::format(
      "pitch {:.4g} mm, chosen as the widest that leaves a ripple of at most {:.3g} % of the removal: {:.3g} % peak to "
      "valley, tracks overlapping by {:.3g} %, deviation of their sum {:.2g} of one track's peak",
      options.pitch, 100.0 * options.ripple, 100.0 * chosen.ripple.pvn, 100.0 * chosen.track.overlap,
      chosen.track.deviation));
  return path;
}

ToolPath plan_multi_pitch(const MultiPitchOptions& options, const PathJob& job) {
  MultiPitchPath planned = multi_pitch_path(job.target, job.tif, job.max_feed, options, job.progress);
  if (!job.estimates) return std::move(planned.path);
  const DepthFeedJob by_depth{job.tif.volume, planned.lowest, job.max_feed, planned.step};
  const DepthFeed cheap = depth_feed(job.target, planned.path, planned.pitch_of_points(), by_depth, job.progress);
  planned.path.notes.push_back(
      fmt::format("by the depth at each point alone (Hou et al. 2017, eq. 12) the dwell would be {:.5g} s, {} of {} "
                  "points at the fastest feed",
                  cheap.total_seconds, cheap.limited, planned.path.size()));
  return std::move(planned.path);
}

/// Fits planners that need nothing of the tool but the distance to go beyond the part.
template <auto plan>
ToolPath with_overrun(auto options, const PathJob& job) {
  if (!options.overrun) options.overrun = job.tif.radius;
  return plan(job.target, options, job.progress);
}

/// The same over a lattice.
template <auto plan>
ToolPath with_lattice_overrun(auto options, const PathJob& job) {
  if (!options.lattice.overrun) options.lattice.overrun = job.tif.radius;
  return plan(job.target, options, job.progress);
}

ToolPath random_tour(const HeightMap& map, const RandomOptions& options, const Progress& progress) {
  return random_path(map, options, progress).path;
}

ToolPath plan_nearest(const NearestOptions& options, const PathJob& job) {
  return nearest_path(job.target, options, job.progress).path;
}

ToolPath plan_from_file(const PathFromFile& spec, const PathJob& job) {
  ToolPath path = read_path_file(spec.file, job.progress);
  for (std::size_t j = 0; j < path.size(); ++j) {
    check_near_part(path.points[j], job.target.grid, job.tif.radius,
                    [&] { return fmt::format("{}: dwell point {}", spec.file.string(), j + 1); });
  }
  refuse_outside(path, job, spec.file.string());
  return path;
}

PathFromFile parse_file(const SpecText& spec) {
  const std::string file = split_kind(spec.text).second;
  if (file.empty()) refuse(spec.text, "the name of a file is missing; required: file:PATH.csv");
  return {file};
}

std::vector<PathDistance> no_distances(const PathFromFile&) { return {}; }

template <class Options>
std::vector<PathDistance> distances_of_lattice(const Options& options) {
  return lattice_distances(options.lattice);
}

/// The texts of a row.
struct Words {
  const char *name, *usage, *about, *spacing;
};

/// A row whose functions know the type of the options. Each planner must say its distances.
template <class Options>
PathRecord row(const Words& words, Options (*parse)(const SpecText&),
               std::vector<PathDistance> (*distances)(const Options&), auto plan) {
  return {words.name,
          words.usage,
          words.about,
          words.spacing,
          [parse](const SpecText& spec) { return std::any(parse(spec)); },
          [distances](const std::any& options) { return distances(std::any_cast<const Options&>(options)); },
          [plan](const std::any& options, const PathJob& job) {
            return plan(std::any_cast<const Options&>(options), job);
          }};
}

std::vector<PathRecord> make_catalogue() {
  std::vector<PathRecord> rows{
      row<RasterOptions>({"raster",
                          "pitch=MM|auto[,ripple=SHARE][,step=MM][,angle=DEGREES][,overrun=MM][,order=serpentine|one-"
                          "way][,turn=square|arc|lift][,corner=MM]",
                          "straight lines", "pitch"},
                         parse_raster_options, raster_distances, plan_raster),
      row<CrossHatchOptions>(
          {"cross-hatch",
           "pitch=MM[,step=MM][,angle=DEGREES][,crossing=DEGREES][,overrun=MM][,turn=square|arc|lift][,corner=MM]",
           "two rasters that cross, one after the other", "pitch"},
          parse_cross_hatch_options, cross_hatch_distances,
          [](const CrossHatchOptions& o, const PathJob& job) { return with_overrun<cross_hatch_path>(o, job); }),
      row<RandomRasterOptions>(
          {"random-raster",
           "pitch=MM[,spread=MM|N%][,step=MM][,angle=DEGREES][,overrun=MM][,order=serpentine|one-way][,turn=square|arc|"
           "lift][,corner=MM][,seed=N]",
           "straight lines at random distances about the pitch", "pitch"},
          parse_random_raster_options, random_raster_distances,
          [](const RandomRasterOptions& o, const PathJob& job) { return with_overrun<random_raster_path>(o, job); }),
      row<SpiralOptions>({"spiral", "pitch=MM[,step=MM][,overrun=MM][,centre=X/Y][,from=centre|edge][,turn=ccw|cw]",
                          "Archimedean spiral, dwell points at equal arc lengths", "pitch"},
                         parse_spiral_options, spiral_distances,
                         [](const SpiralOptions& o, const PathJob& job) { return with_overrun<spiral_path>(o, job); }),
      row<CirclesOptions>(
          {"circles", "pitch=MM[,step=MM][,overrun=MM][,centre=X/Y][,from=centre|edge][,turn=ccw|cw]",
           "concentric circles", "pitch"},
          parse_circles_options, circles_distances,
          [](const CirclesOptions& o, const PathJob& job) { return with_overrun<circles_path>(o, job); }),
      row<FibonacciOptions>(
          {"fibonacci", "pitch=MM[,overrun=MM][,centre=X/Y]", "phyllotaxis lattice, along its spiral arms", "pitch"},
          parse_fibonacci_options, fibonacci_distances,
          [](const FibonacciOptions& o, const PathJob& job) { return with_overrun<fibonacci_path>(o, job); }),
      row<NearestOptions>({"nearest", "cell=MM[,critical=NM][,lift=CELLS|inf][,start=X/Y][,improve=none|2opt]",
                           "from cell to nearest cell, only where the map is above the critical value", "cell"},
                          parse_nearest_options, nearest_distances, plan_nearest),
      row<RandomOptions>(
          {"random", "pitch=MM[,overrun=MM][,angle=DEGREES][,seed=N]",
           "pseudo-random: through every point of a square lattice once, from neighbour to neighbour", "pitch"},
          parse_random_options, distances_of_lattice<RandomOptions>,
          [](const RandomOptions& o, const PathJob& job) { return with_lattice_overrun<random_tour>(o, job); }),
      row<HilbertOptions>(
          {"hilbert", "pitch=MM[,overrun=MM][,angle=DEGREES][,gaps=link|lift]", "Hilbert's curve over a square lattice",
           "pitch"},
          parse_hilbert_options, distances_of_lattice<HilbertOptions>,
          [](const HilbertOptions& o, const PathJob& job) { return with_lattice_overrun<hilbert_path>(o, job); }),
      row<PeanoOptions>(
          {"peano", "pitch=MM[,overrun=MM][,angle=DEGREES][,gaps=link|lift]", "Peano's curve over a square lattice",
           "pitch"},
          parse_peano_options, distances_of_lattice<PeanoOptions>,
          [](const PeanoOptions& o, const PathJob& job) { return with_lattice_overrun<peano_path>(o, job); }),
      row<MultiPitchOptions>(
          {"multi-pitch",
           "[ranges=N][,pitches=MM/MM/...][,depths=NM/NM/"
           "...][,min-pitch=MM][,max-pitch=MM][,step=MM][,angle=DEGREES][,overrun=MM][,lift=PITCHES|inf][,smooth=MM]",
           "straight lines, closer together where more is to be removed", ""},
          parse_multi_pitch_options, multi_pitch_distances, plan_multi_pitch),
      row<LinePathOptions>(
          {"line", "step=MM[,y=MM][,overrun=MM]", "one track along x, for a profile or a strip", "step"},
          parse_line_path_options, line_path_distances,
          [](const LinePathOptions& o, const PathJob& job) { return with_overrun<line_path>(o, job); }),
      row<PathFromFile>({"file", "PATH.csv", "dwell points in the order of a file", ""}, parse_file, no_distances,
                        plan_from_file),
  };
  rows.back().one_value = true;
  return rows;
}

/// "file:PATH.csv" is not split at commas, because a name may hold them.
SpecText spec_text_of(const std::string& text) {
  const std::string kind = split_kind(text).first;
  const bool one_value = std::any_of(path_catalogue().begin(), path_catalogue().end(),
                                     [&](const PathRecord& record) { return record.one_value && record.name == kind; });
  return one_value ? SpecText{"path", text, kind, {}} : parse_spec_text(text, "path");
}

}  // namespace

const std::vector<PathRecord>& path_catalogue() {
  static const std::vector<PathRecord> kCatalogue = make_catalogue();
  return kCatalogue;
}

PathSpec parse_path_spec(const std::string& text) {
  const SpecText spec = spec_text_of(text);
  std::string accepted;
  for (const PathRecord& record : path_catalogue()) {
    if (record.name == spec.kind) return {&record, text, record.parse(spec)};
    accepted += (accepted.empty() ? "" : ", ") + record.name;
  }
  refuse(text, fmt::format("unknown kind \"{}\"; accepted: {}", spec.kind, accepted));
}

std::string to_string(const PathSpec& spec) { return spec.text; }

ToolPath plan_path(const PathSpec& spec, const PathJob& job) {
  if (!spec.given()) throw std::logic_error("plan_path: the path has no record");
  for (const PathDistance& distance : spec.record->distances(spec.options)) check_distance(distance, job);
  ToolPath path = spec.record->plan(spec.options, job);
  note_long_moves(path, job);
  return path;
}

}  // namespace dwell
