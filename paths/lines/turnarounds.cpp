#include "paths/lines/turnarounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.h"
#include "core/base/poll.h"

namespace dwell {
namespace {

constexpr double kFewestOnArc = 6.0;  // parts of 30 degrees

double points_on_arc(double distance, double step) {
  return std::max(kFewestOnArc, std::round(0.5 * std::numbers::pi * distance / step));
}

void append(ToolPath& path, Point p, bool lifted = false) {
  path.points.push_back(p);
  path.lifted.push_back(lifted ? 1 : 0);
}

/// From point `end` of line `from`, where the tool goes in direction `sense` (1 or -1) along, to point `start` of line
/// `to`, both excluded.
void append_arc_link(ToolPath& path, const ScanLines& lines, Index from, Index end, Index to, Index start,
                     Index sense) {
  const Index level = sense > 0 ? std::max(end, start) : std::min(end, start);
  for (Index i = end; i != level;) append(path, lines.at(from, i += sense));
  const double low = lines.position(from), high = lines.position(to);
  const double radius = 0.5 * (high - low);  // signed, so that the arc leaves `from` whichever side `to` is on
  const double count = points_on_arc(std::abs(high - low), lines.steps().step);
  for (double i = 0.5; i < count; ++i) {
    const double turned = std::numbers::pi * i / count;
    const double out = static_cast<double>(sense) * std::abs(radius) * std::sin(turned);
    append(path, lines.place(lines.steps().at(level) + out, 0.5 * (low + high) - radius * std::cos(turned)));
  }
  for (Index i = level; i != start; i -= sense) append(path, lines.at(to, i));
}

}  // namespace

TurnOptions parse_turn_options(const SpecText& spec) {
  const std::string turn = spec.choice("turn", {"square", "arc", "lift"});
  return {turn == "arc"    ? Turnaround::Arc
          : turn == "lift" ? Turnaround::Lift
                           : Turnaround::Square,
          spec.number("corner", 0.0)};
}

void check_turn_options(const TurnOptions& turns, bool serpentine, const char* planner) {
  if (!(std::isfinite(turns.corner) && turns.corner >= 0.0)) {
    throw InputError(fmt::format("{}: corner = {} mm; required finite and >= 0", planner, turns.corner));
  }
  if (turns.turn == Turnaround::Arc && !serpentine) {
    throw InputError(
        fmt::format("{}: turn = arc with order = one-way, whose returns are lifted; required order = "
                    "serpentine, or turn = lift",
                    planner));
  }
}

double most_points_on_arc(const TurnOptions& turns, double distance, double step) {
  return turns.turn == Turnaround::Arc ? points_on_arc(distance, step) : 0.0;
}

void append_lines(ToolPath& path, const ScanLines& lines, const LineOrder& order, const TurnOptions& turns,
                  const Progress& progress) {
  Poll poll(progress);
  bool backwards = order.first_backwards;
  bool gap = true;
  Index before = -1;
  path.points.reserve(path.size() + lines.points());
  path.lifted.reserve(path.size() + lines.points());
  for (Index n = 0; n < lines.count(); ++n) {
    const Index line = order.from_last_line ? lines.count() - 1 - n : n;
    progress.check();
    const ScanLines::Run run = lines.run(line);
    if (run.empty()) {
      gap = true;
      continue;
    }
    const bool lifted = gap || !order.serpentine || turns.turn == Turnaround::Lift;
    const Index start = backwards ? run.last : run.first;
    if (!lifted && turns.turn == Turnaround::Arc) {
      const ScanLines::Run& last = lines.run(before);
      append_arc_link(path, lines, before, backwards ? last.last : last.first, line, start, backwards ? 1 : -1);
    }
    for (Index k = 0; k <= run.last - run.first; ++k) {
      poll.step();
      append(path, lines.at(line, backwards ? run.last - k : run.first + k), k == 0 && lifted);
    }
    backwards = order.serpentine && !backwards;
    gap = false;
    before = line;
  }
}

}  // namespace dwell
