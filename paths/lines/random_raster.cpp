#include "paths/lines/random_raster.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/random_numbers.h"
#include "paths/domain/rounding.h"
#include "paths/lines/corner_rounding.h"
#include "paths/lines/scan_lines.h"

namespace dwell {
namespace {

constexpr const char* kRandomRaster = "random-raster";
constexpr double kLargestSeed = 9007199254740992.0;  // 2^53: up to here a double holds every whole number

std::uint64_t parse_seed(const SpecText& spec) {
  const double seed = spec.number("seed", 1.0);
  if (!(seed >= 0.0 && seed <= kLargestSeed && seed == std::floor(seed))) {
    spec.reject("seed", "a whole number from 0 to 2^53");
  }
  return static_cast<std::uint64_t>(seed);
}

double parse_spread(const SpecText& spec, double pitch, double fallback) {
  const std::optional<std::string> text = spec.word("spread");
  if (!text) return fallback;
  if (!text->ends_with('%')) return spec.number("spread") / pitch;
  const std::optional<double> percent = parse_number(text->substr(0, text->size() - 1));
  if (!percent) spec.reject("spread", "a length in mm or a share of the pitch, for instance spread=20%");
  return *percent / 100.0;
}

/// Positions of as many lines as fit into a range; their block lies in the middle of it.
std::vector<double> draw_positions(const Interval& range, const RandomRasterOptions& options, const ScanOptions& scan,
                                   double points_a_line) {
  RandomNumbers dice(options.seed);
  const double width = range.length() + 2.0 * scan.overrun;
  std::vector<double> positions{0.0};
  while (true) {
    const double share = static_cast<double>(dice.bits() >> 11) * 0x1p-53;  // 0 to 1, the same on every machine
    const double next = positions.back() + options.pitch * (1.0 + options.spread * (2.0 * share - 1.0));
    if (next > width + kRounding * options.pitch) break;
    positions.push_back(next);
    check_scan_size(scan, static_cast<double>(positions.size()), points_a_line, kRandomRaster);
  }
  const double shift = 0.5 * (range.low + range.high) - 0.5 * positions.back();
  for (double& position : positions) position += shift;
  return positions;
}

}  // namespace

RandomRasterOptions parse_random_raster_options(const SpecText& spec) {
  spec.accept_only({"pitch", "spread", "step", "angle", "overrun", "order", "turn", "corner", "seed"});
  RandomRasterOptions options;
  options.pitch = spec.number("pitch");
  options.spread = parse_spread(spec, options.pitch, options.spread);
  options.step = spec.optional_number("step");
  options.angle_deg = spec.number("angle", options.angle_deg);
  options.overrun = spec.optional_number("overrun");
  options.serpentine = spec.choice("order", {"serpentine", "one-way"}) == "serpentine";
  options.turns = parse_turn_options(spec);
  options.seed = parse_seed(spec);
  return options;
}

std::vector<PathDistance> random_raster_distances(const RandomRasterOptions& options) {
  return {{"pitch", options.pitch}, {"step", options.step.value_or(0.0)}};
}

ToolPath random_raster_path(const HeightMap& map, const RandomRasterOptions& options, const Progress& progress) {
  const ScanOptions scan{options.pitch, options.step.value_or(options.pitch), options.angle_deg,
                         options.overrun.value_or(0.0)};
  check_scan_options(scan, kRandomRaster);
  check_turn_options(options.turns, options.serpentine, kRandomRaster);
  if (!(options.spread >= 0.0 && options.spread < 1.0)) {
    throw InputError(fmt::format("{}: spread = {} mm, {} of the pitch; required >= 0 and less than the pitch",
                                 kRandomRaster, options.spread * options.pitch, options.spread));
  }
  const ScanFrame frame = scan_frame(map, scan.angle_deg, kRandomRaster);
  const EvenPositions steps(frame.u, scan.overrun, scan.step);
  const double farthest = options.pitch * (1.0 + options.spread);
  const double points_a_line = steps.count + most_points_on_arc(options.turns, farthest, scan.step);
  check_scan_size(scan, EvenPositions(frame.v, scan.overrun, scan.pitch).count, points_a_line, kRandomRaster);

  ToolPath path;
  path.kind = kRandomRaster;
  LinePositions lines(draw_positions(frame.v, options, scan, points_a_line));
  const Index count = lines.count();
  append_lines(path, ScanLines(map, frame, steps, std::move(lines), scan.overrun, progress), {options.serpentine},
               options.turns, progress);
  path.notes.push_back(fmt::format("{} at random distances from {:.6g} to {:.6g} mm, seed {}", counted(count, "line"),
                                   options.pitch * (1.0 - options.spread), farthest, options.seed));
  return options.turns.corner > 0.0 ? round_corners(path, options.turns.corner, progress) : path;
}

}  // namespace dwell
