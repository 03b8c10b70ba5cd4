#include "paths/lines/raster.h"

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "paths/lines/corner_rounding.h"
#include "paths/lines/scan_lines.h"

namespace dwell {

RasterOptions parse_raster_options(const SpecText& spec) {
  spec.accept_only({"pitch", "ripple", "step", "angle", "overrun", "order", "turn", "corner"});
  RasterOptions options;
  const std::optional<std::string> pitch = spec.word("pitch");
  options.auto_pitch = pitch == "auto";
  if (pitch && !options.auto_pitch && !parse_number(*pitch)) spec.reject("pitch", "a number in mm, or auto");
  if (!options.auto_pitch) options.pitch = spec.number("pitch");
  if (!options.auto_pitch && spec.has("ripple")) spec.reject("ripple", "pitch=auto with it");
  options.ripple = spec.number("ripple", options.ripple);
  options.step = spec.optional_number("step");
  options.angle_deg = spec.number("angle", options.angle_deg);
  options.overrun = spec.optional_number("overrun");
  options.serpentine = spec.choice("order", {"serpentine", "one-way"}) == "serpentine";
  options.turns = parse_turn_options(spec);
  return options;
}

std::vector<PathDistance> raster_distances(const RasterOptions& options) {
  return {{"pitch", options.pitch}, {"step", options.step.value_or(0.0)}};
}

ToolPath raster_path(const HeightMap& map, const RasterOptions& options, const Progress& progress) {
  const ScanOptions scan{options.pitch, options.step.value_or(options.pitch), options.angle_deg,
                         options.overrun.value_or(0.0)};
  check_scan_options(scan, "raster");
  check_turn_options(options.turns, options.serpentine, "raster");
  const ScanFrame frame = scan_frame(map, scan.angle_deg, "raster");
  const EvenPositions steps(frame.u, scan.overrun, scan.step);
  const EvenPositions lines(frame.v, scan.overrun, scan.pitch);
  const double on_arc = most_points_on_arc(options.turns, scan.pitch, scan.step);
  check_scan_size(scan, lines.count, steps.count + on_arc, "raster");

  ToolPath path;
  path.kind = "raster";
  append_lines(path, ScanLines(map, frame, steps, LinePositions(lines), scan.overrun, progress), {options.serpentine},
               options.turns, progress);
  return options.turns.corner > 0.0 ? round_corners(path, options.turns.corner, progress) : path;
}

}  // namespace dwell
