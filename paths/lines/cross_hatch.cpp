#include "paths/lines/cross_hatch.h"

#include <fmt/format.h>

#include <limits>

#include "core/base/errors.h"
#include "paths/domain/point_limit.h"
#include "paths/lines/corner_rounding.h"
#include "paths/lines/scan_lines.h"

namespace dwell {
namespace {

constexpr const char* kCrossHatch = "cross-hatch";

struct Pass {
  ScanFrame frame;
  EvenPositions steps;
  EvenPositions lines;
  double most_points;
};

Pass make_pass(const HeightMap& map, const ScanOptions& scan, const TurnOptions& turns) {
  const ScanFrame frame = scan_frame(map, scan.angle_deg, kCrossHatch);
  const EvenPositions steps(frame.u, scan.overrun, scan.step);
  const EvenPositions lines(frame.v, scan.overrun, scan.pitch);
  const double points = steps.count + most_points_on_arc(turns, scan.pitch, scan.step);
  check_scan_size(scan, lines.count, points, kCrossHatch);
  return {frame, steps, lines, lines.count * points};
}

ScanLines lines_of(const HeightMap& map, const Pass& pass, double overrun, const Progress& progress) {
  return {map, pass.frame, pass.steps, LinePositions(pass.lines), overrun, progress};
}

/// The serpentine that begins nearest to a point; of equally near ones the first line forwards, first line backwards,
/// last line forwards.
LineOrder order_from(Point tool, const ScanLines& lines) {
  Index first = 0, last = lines.count() - 1;
  while (lines.run(first).empty()) ++first;
  while (lines.run(last).empty()) --last;
  LineOrder best;
  double least = std::numeric_limits<double>::infinity();
  for (const bool from_last : {false, true}) {
    const Index line = from_last ? last : first;
    for (const bool backwards : {false, true}) {
      const ScanLines::Run& run = lines.run(line);
      const double away = distance(tool, lines.at(line, backwards ? run.last : run.first));
      if (away < least) {
        least = away;
        best = {true, from_last, backwards};
      }
    }
  }
  return best;
}

}  // namespace

CrossHatchOptions parse_cross_hatch_options(const SpecText& spec) {
  spec.accept_only({"pitch", "step", "angle", "crossing", "overrun", "turn", "corner"});
  CrossHatchOptions options;
  options.pitch = spec.number("pitch");
  options.step = spec.optional_number("step");
  options.angle_deg = spec.number("angle", options.angle_deg);
  options.crossing_deg = spec.number("crossing", options.crossing_deg);
  options.overrun = spec.optional_number("overrun");
  options.turns = parse_turn_options(spec);
  return options;
}

std::vector<PathDistance> cross_hatch_distances(const CrossHatchOptions& options) {
  return {{"pitch", options.pitch}, {"step", options.step.value_or(0.0)}};
}

ToolPath cross_hatch_path(const HeightMap& map, const CrossHatchOptions& options, const Progress& progress) {
  ScanOptions scan{options.pitch, options.step.value_or(options.pitch), options.angle_deg,
                   options.overrun.value_or(0.0)};
  check_scan_options(scan, kCrossHatch);
  check_turn_options(options.turns, true, kCrossHatch);
  if (!(options.crossing_deg > 0.0 && options.crossing_deg < 180.0)) {
    throw InputError(
        fmt::format("{}: crossing = {} degrees; required > 0 and < 180", kCrossHatch, options.crossing_deg));
  }
  const Pass first = make_pass(map, scan, options.turns);
  scan.angle_deg += options.crossing_deg;
  const Pass second = make_pass(map, scan, options.turns);
  if (!(first.most_points + second.most_points <= kMaxPathPoints)) {
    throw InputError(fmt::format(
        "{}: pitch = {} mm and step = {} mm make up to {:.3g} points in both passes; at most {:.0e} accepted, make "
        "pitch or step larger",
        kCrossHatch, scan.pitch, scan.step, first.most_points + second.most_points, kMaxPathPoints));
  }

  ToolPath path;
  path.kind = kCrossHatch;
  append_lines(path, lines_of(map, first, scan.overrun, progress), {}, options.turns, progress);
  const ScanLines across = lines_of(map, second, scan.overrun, progress);
  append_lines(path, across, order_from(path.points.back(), across), options.turns, progress);
  return options.turns.corner > 0.0 ? round_corners(path, options.turns.corner, progress) : path;
}

}  // namespace dwell
