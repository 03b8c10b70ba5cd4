#include "paths/lines/scan_lines.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/point.h"
#include "core/base/poll.h"
#include "paths/domain/distance_map.h"
#include "paths/domain/feed_direction.h"
#include "paths/domain/point_limit.h"
#include "paths/domain/rounding.h"

namespace dwell {
namespace {

double smallest_gap(const LinePositions& lines, double step) {
  double least = step;
  for (Index line = 1; line < lines.count(); ++line) least = std::min(least, lines.at(line) - lines.at(line - 1));
  return least;
}

}  // namespace

EvenPositions::EvenPositions(const Interval& range, double overrun, double tick)
    : middle(0.5 * (range.low + range.high)),
      step(tick),
      count(std::floor((range.high - range.low + 2.0 * overrun) / step + kRounding) + 1.0) {}

Index EvenPositions::nearest(double v) const {
  return static_cast<Index>(std::clamp(std::floor((v - at(0)) / step + 0.5), 0.0, count - 1.0));
}

LinePositions::LinePositions(const EvenPositions& regular) : regular_(regular) {
  positions_.resize(static_cast<std::size_t>(regular.count));
  for (Index i = 0; i < count(); ++i) positions_[static_cast<std::size_t>(i)] = regular.at(i);
}

Index LinePositions::nearest(double v) const {
  if (regular_) return regular_->nearest(v);
  const auto above = std::upper_bound(positions_.begin(), positions_.end(), v);
  if (above == positions_.begin()) return 0;
  if (above == positions_.end()) return count() - 1;
  const Index line = above - positions_.begin();
  return *above - v <= v - at(line - 1) ? line : line - 1;
}

void check_scan_options(const ScanOptions& options, const char* planner) {
  const auto refuse = [planner](const char* option, double value, const char* unit, const char* required) {
    throw InputError(fmt::format("{}: {} = {}{}; required {}", planner, option, value, unit, required));
  };
  if (!(options.pitch > 0.0)) refuse("pitch", options.pitch, " mm", "> 0");
  if (!std::isfinite(options.pitch)) refuse("pitch", options.pitch, " mm", "finite");
  if (!(options.step > 0.0)) refuse("step", options.step, " mm", "> 0");
  if (!std::isfinite(options.step)) refuse("step", options.step, " mm", "finite");
  if (!std::isfinite(options.angle_deg)) refuse("angle", options.angle_deg, " degrees", "finite");
  if (!(options.overrun >= 0.0)) refuse("overrun", options.overrun, " mm", ">= 0");
  if (!std::isfinite(options.overrun)) refuse("overrun", options.overrun, " mm", "finite");
}

ScanFrame scan_frame(const HeightMap& map, double angle_deg, const char* planner) {
  ScanFrame frame;
  frame.along = feed_direction(angle_deg);
  frame.across = {-frame.along.y, frame.along.x};
  const Grid& grid = map.grid;
  for (Index row = 0; row < grid.rows; ++row) {
    // Both coordinates are linear along a row, so its first and last valid pixel decide.
    const auto include = [&](Index col) {
      const Point p = grid.centre(row, col);
      frame.u.include(dot(p, frame.along));
      frame.v.include(dot(p, frame.across));
    };
    Index first = 0, last = grid.cols - 1;
    while (first < grid.cols && !std::isfinite(map.at(row, first))) ++first;
    if (first == grid.cols) continue;
    while (!std::isfinite(map.at(row, last))) --last;
    include(first);
    include(last);
  }
  if (frame.u.length() >= 0.0) return frame;
  throw InputError(fmt::format("{}: the map has no finite pixel; at least one is required", planner));
}

void check_scan_size(const ScanOptions& options, double lines, double points, const char* planner) {
  const double count = lines * points;
  if (count <= kMaxPathPoints) return;
  throw InputError(
      fmt::format("{}: pitch = {} mm and step = {} mm make {:.4g} lines of {:.4g} points, {:.3g} in "
                  "all, over the part and its overrun; at most {:.0e} accepted, make pitch or step larger or overrun "
                  "smaller",
                  planner, options.pitch, options.step, lines, points, count, kMaxPathPoints));
}

ScanLines::ScanLines(const HeightMap& map, const ScanFrame& frame, const EvenPositions& steps, LinePositions lines,
                     double overrun, const Progress& progress)
    : along_(frame.along),
      across_(frame.across),
      steps_(steps),
      lines_(std::move(lines)),
      runs_(static_cast<std::size_t>(lines_.count())) {
  include_nearest(map, progress);
  include_within(map, overrun, progress);
}

void ScanLines::include_nearest(const HeightMap& map, const Progress& progress) {
  const Grid& grid = map.grid;
  for (Index row = 0; row < grid.rows; ++row) {
    progress.check();
    for (Index col = 0; col < grid.cols; ++col) {
      if (!std::isfinite(map.at(row, col))) continue;
      const Point p = grid.centre(row, col);
      runs_[static_cast<std::size_t>(lines_.nearest(dot(p, across_)))].include(steps_.nearest(dot(p, along_)));
    }
  }
}

void ScanLines::include_within(const HeightMap& map, double overrun, const Progress& progress) {
  const DistanceMap distance(map, overrun, progress);
  const double reach = overrun + kRounding * smallest_gap(lines_, steps_.step);
  const auto step_count = static_cast<Index>(steps_.count);
  Poll poll(progress);
  for (Index line = 0; line < count(); ++line) {
    progress.check();
    Run& run = runs_[static_cast<std::size_t>(line)];
    // 0 if point i is wanted; else how many points to go on: those between are too far away because point i is.
    const auto points_to_skip = [&](Index i) -> Index {
      poll.step();
      const Point p = at(line, i);
      const double spare = distance.bounds(p).low - reach;
      if (spare >= steps_.step) return static_cast<Index>(std::min(spare / steps_.step, steps_.count));
      return distance.within(p, reach) ? 0 : 1;
    };
    const Index known_first = std::min(run.first, step_count);
    Index first = 0;
    while (first < known_first) {
      const Index skip = points_to_skip(first);
      if (skip == 0) break;
      first += skip;
    }
    first = std::min(first, known_first);
    if (first == step_count) continue;
    run.include(first);
    Index last = step_count - 1;
    while (last > run.last) {
      const Index skip = points_to_skip(last);
      if (skip == 0) break;
      last -= skip;
    }
    run.include(std::max(last, run.last));
  }
}

std::size_t ScanLines::points() const {
  std::size_t sum = 0;
  for (const Run& run : runs_) sum += run.empty() ? 0 : static_cast<std::size_t>(run.last - run.first + 1);
  return sum;
}

}  // namespace dwell
