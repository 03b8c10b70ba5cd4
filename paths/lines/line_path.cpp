#include "paths/lines/line_path.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/poll.h"
#include "paths/domain/rounding.h"
#include "paths/lines/scan_lines.h"

namespace dwell {
namespace {

constexpr const char* kLine = "line";

/// How far the valid pixels reach along x whose rows touch the line.
Interval extent_on_line(const HeightMap& map, double y, const Progress& progress) {
  const Grid& g = map.grid;
  Interval extent, rows;
  for (Index row = 0; row < g.rows; ++row) {
    progress.check();
    const bool touches = std::abs(g.y(row) - y) <= (0.5 + kRounding) * g.pitch_y;
    for (Index col = 0; col < g.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      rows.include(g.y(row));
      if (touches) extent.include(g.x(col));
    }
  }
  if (extent.length() >= 0.0) return extent;
  if (!(rows.length() >= 0.0)) throw InputError(fmt::format("{}: the map has no finite pixel", kLine));
  throw InputError(
      fmt::format("{}: y = {:.6g} mm: the line meets no pixel with data; the part has y from {:.6g} to {:.6g} mm",
                  kLine, y, rows.low, rows.high));
}

}  // namespace

LinePathOptions parse_line_path_options(const SpecText& spec) {
  spec.accept_only({"step", "y", "overrun"});
  LinePathOptions options;
  options.step = spec.number("step");
  options.y = spec.number("y", options.y);
  options.overrun = spec.optional_number("overrun");
  return options;
}

std::vector<PathDistance> line_path_distances(const LinePathOptions& options) { return {{"step", options.step}}; }

ToolPath line_path(const HeightMap& map, const LinePathOptions& options, const Progress& progress) {
  const ScanOptions scan{1.0, options.step, 0.0, options.overrun.value_or(0.0)};
  check_scan_options(scan, kLine);
  if (!std::isfinite(options.y)) throw InputError(fmt::format("{}: y = {} mm; required finite", kLine, options.y));
  const EvenPositions steps(extent_on_line(map, options.y, progress), scan.overrun, scan.step);
  check_scan_size(scan, 1.0, steps.count, kLine);
  const auto count = static_cast<Index>(steps.count);
  ToolPath path;
  path.kind = kLine;
  path.points.reserve(static_cast<std::size_t>(count));
  Poll poll(progress, 4096);
  for (Index i = 0; i < count; ++i) {
    poll.step();
    path.points.push_back({steps.at(i), options.y});
  }
  path.lifted.assign(path.points.size(), 0);
  path.lifted.front() = 1;
  return path;
}

}  // namespace dwell
