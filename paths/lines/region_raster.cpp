#include "paths/lines/region_raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.h"
#include "core/base/point.h"
#include "core/base/poll.h"
#include "paths/domain/feed_direction.h"
#include "paths/domain/point_limit.h"
#include "paths/domain/rounding.h"
#include "paths/lines/run_order.h"

namespace dwell {
namespace {

/// Equidistant positions.
struct RegionTicks {
  double first = 0.0;
  double step = 1.0;
  double count = 1.0;  // integral

  double at(Index i) const { return first + step * static_cast<double>(i); }
  Index nearest(double v) const {
    return static_cast<Index>(std::clamp(std::floor((v - first) / step + 0.5), 0.0, count - 1.0));
  }
};

/// As many as fit between two places, symmetric about their middle.
RegionTicks symmetric_ticks(double low, double high, double step) {
  const double count = std::floor((high - low) / step + kRounding) + 1.0;
  return {0.5 * (low + high) - 0.5 * step * (count - 1.0), step, count};
}

/// All between two places that are whole steps from the anchor; at least one.
RegionTicks anchored_ticks(double low, double high, double step, double anchor) {
  const double from = std::ceil((low - anchor) / step - kRounding);
  return {anchor + step * from, step, std::max(0.0, std::floor((high - anchor) / step + kRounding) - from) + 1.0};
}

struct Lattice {
  Point along, across;
  RegionTicks steps, lines;

  Point at(Index line, Index step) const { return steps.at(step) * along + lines.at(line) * across; }
};

Lattice lattice_of(const Grid& grid, const std::vector<Index>& pixels, const RegionLines& lines) {
  const Point along = feed_direction(lines.angle_deg), across{-along.y, along.x};
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high = -1.0 * low;
  for (const Index i : pixels) {
    const Point p = grid.centre(i);
    const double u = dot(p, along), v = dot(p, across);
    low = {std::min(low.x, u), std::min(low.y, v)};
    high = {std::max(high.x, u), std::max(high.y, v)};
  }
  const double reach = lines.reach;
  return {along, across, anchored_ticks(low.x - reach, high.x + reach, lines.step, lines.anchor),
          symmetric_ticks(low.y - reach, high.y + reach, lines.pitch)};
}

[[noreturn]] void refuse_points(const RegionLines& lines, double points) {
  throw InputError(
      fmt::format("multi-pitch: a pitch of {:.4g} mm with steps of {:.4g} mm makes {:.3g} points or more; at most "
                  "{:.0e} accepted in all, make min-pitch, pitches or step larger",
                  lines.pitch, lines.step, points, lines.most_points));
}

/// Lattice points of a region, line by line: stretches without a gap.
class Stretches {
 public:
  Stretches(const RegionLabels& labels, const Lattice& lattice, const RegionLines& lines)
      : labels_(labels), lattice_(lattice), lines_(lines) {}

  void find(const Progress& progress) {
    Poll poll(progress);
    const auto line_count = static_cast<Index>(lattice_.lines.count);
    const auto step_count = static_cast<Index>(lattice_.steps.count);
    for (Index line = 0; line < line_count; ++line) {
      progress.check();
      Index begin = -1;
      for (Index i = 0; i <= step_count; ++i) {
        poll.step();
        const bool in = i < step_count && inside(line, i);
        if (in && begin < 0) begin = i;
        if (in || begin < 0) continue;
        add({line, begin, i - 1});
        begin = -1;
      }
    }
  }

  /// Adds the nearest lattice point for pixels that have none near.
  void rescue(const Grid& grid, const std::vector<Index>& pixels, const Progress& progress) {
    Poll poll(progress);
    const std::size_t found = stretches_.size();
    for (const Index i : pixels) {
      poll.step();
      const Point p = grid.centre(i);
      const Index line = lattice_.lines.nearest(dot(p, lattice_.across));
      const Index step = lattice_.steps.nearest(dot(p, lattice_.along));
      if (inside(line, step) || neighbour_near(p, line, step)) continue;
      add({line, step, step});
    }
    if (stretches_.size() == found) return;
    std::sort(stretches_.begin(), stretches_.end(), [](const LineRun& a, const LineRun& b) {
      return a.line != b.line ? a.line < b.line : a.first < b.first;
    });
    // Several pixels may have asked for the same point.
    const auto same = [](const LineRun& a, const LineRun& b) { return a.line == b.line && a.first == b.first; };
    stretches_.erase(std::unique(stretches_.begin(), stretches_.end(), same), stretches_.end());
  }

  const std::vector<LineRun>& stretches() const { return stretches_; }

 private:
  bool inside(Index line, Index step) const { return labels_.at(lattice_.at(line, step)) == lines_.region; }

  bool neighbour_near(Point p, Index line, Index step) const {
    const double near = std::max(lines_.pitch, lines_.step);
    for (Index l = line - 1; l <= line + 1; ++l) {
      for (Index s = step - 1; s <= step + 1; ++s) {
        if (l < 0 || s < 0 || l >= static_cast<Index>(lattice_.lines.count) ||
            s >= static_cast<Index>(lattice_.steps.count)) {
          continue;
        }
        if (distance(lattice_.at(l, s), p) <= near && inside(l, s)) return true;
      }
    }
    return false;
  }

  void add(const LineRun& run) {
    points_ += static_cast<double>(run.last - run.first + 1);
    if (points_ > lines_.most_points) refuse_points(lines_, points_);
    stretches_.push_back(run);
  }

  const RegionLabels& labels_;
  const Lattice& lattice_;
  const RegionLines& lines_;
  std::vector<LineRun> stretches_;
  double points_ = 0.0;
};

/// Runs, which may cross short gaps, and where the stretches of each begin.
struct Runs {
  std::vector<LineRun> runs;
  std::vector<std::size_t> begin;
};

Runs join_stretches(const std::vector<LineRun>& stretches, double step, double link) {
  Runs joined;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const LineRun& s = stretches[i];
    const bool on =
        i > 0 && s.line == stretches[i - 1].line && static_cast<double>(s.first - stretches[i - 1].last) * step <= link;
    if (on) {
      joined.runs.back().last = s.last;
    } else {
      joined.runs.push_back(s);
      joined.begin.push_back(i);
    }
  }
  joined.begin.push_back(stretches.size());
  return joined;
}

void append(const Lattice& lattice, const LineRun& stretch, bool backwards, ToolPath& path) {
  const Point foot = lattice.lines.at(stretch.line) * lattice.across;
  const Index count = stretch.last - stretch.first + 1;
  for (Index k = 0; k < count; ++k) {
    path.points.push_back(lattice.steps.at(backwards ? stretch.last - k : stretch.first + k) * lattice.along + foot);
  }
  path.lifted.resize(path.points.size(), 0);
}

}  // namespace

Index append_region(const RegionLabels& labels, const Grid& grid, const std::vector<Index>& pixels,
                    const RegionLines& lines, ToolPath& path, const Progress& progress) {
  const Lattice lattice = lattice_of(grid, pixels, lines);
  const double area = grid.pitch_x * grid.pitch_y * static_cast<double>(pixels.size());
  const double expected = std::max(area / (lines.pitch * lines.step), lattice.lines.count);
  if (!(expected <= lines.most_points)) refuse_points(lines, expected);
  // A narrow ring fills little of its box, which is looked through point by point.
  const double box = lattice.lines.count * lattice.steps.count;
  if (!(box <= 20.0 * kMaxPathPoints)) refuse_points(lines, expected);
  Stretches found(labels, lattice, lines);
  found.find(progress);
  found.rescue(grid, pixels, progress);
  const std::vector<LineRun>& stretches = found.stretches();
  const Runs runs = join_stretches(stretches, lines.step, lines.link);
  const std::vector<OrderedRun> order = order_runs(runs.runs, lines.pitch, lines.step, lines.link, progress);
  Index lifts = -1;
  for (const OrderedRun& next : order) {
    progress.check();
    const std::size_t first_point = path.points.size();
    const std::size_t begin = runs.begin[static_cast<std::size_t>(next.run)];
    const std::size_t end = runs.begin[static_cast<std::size_t>(next.run) + 1];
    for (std::size_t i = begin; i < end; ++i) {
      append(lattice, stretches[next.backwards ? begin + end - 1 - i : i], next.backwards, path);
    }
    if (!next.lifted) continue;
    path.lifted[first_point] = 1;
    ++lifts;
  }
  return lifts;
}

}  // namespace dwell
