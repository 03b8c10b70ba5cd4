#include "runs/plan/machine_program.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "paths/feed/plan_program.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

MachineProgram make_machine_program(const LaidPath& laid, const DwellPlan& dwell, const MachineLimits& machine,
                                    const Progress& progress) {
  MachineProgram program;
  const FeedLimits limits = machine.feed_limits();
  Vector commanded_s = dwell.seconds;
  if (dwell.motion) {
    const std::vector<double>& commanded = dwell.motion->commanded;
    commanded_s = Vector::Map(commanded.data(), static_cast<Index>(commanded.size()));
  }
  program.feed = feed_schedule(laid.strokes, commanded_s, limits);
  // Halts have no length; the machine moves between them at maximum feed.
  if (laid.motion == Motion::Stop) program.feed.min_speed = program.feed.max_speed = limits.max_feed;
  program.table = feed_table_of(laid.path, {commanded_s.begin(), commanded_s.end()}, laid.motion,
                                machine.max_feed_mm_per_min, progress);
  const bool idle = std::all_of(program.table.dwell_s.begin(), program.table.dwell_s.end(),
                                [](double seconds) { return seconds == 0.0; });
  if (idle && program_of(program.table).steps.empty()) {
    throw InputError(fmt::format(
        "the plan stays at {} for no time: its program would hold no move and no halt; required a path with a move, a "
        "`min dwell` above 0, or a smaller `time price`",
        counted(laid.path.size(), "dwell point")));
  }
  if (program.feed.segments_infeasible > 0) {
    program.limits.push_back(fmt::format("{} of {} segments run faster than `max feed` {} mm/min allows",
                                         program.feed.segments_infeasible, laid.path.size(),
                                         machine.max_feed_mm_per_min));
  }
  return program;
}

TravelTimes travel_times(const LaidPath& laid, double lift_height_mm, const MachineLimits& machine) {
  const double max_feed = machine.feed_limits().max_feed, lifts = static_cast<double>(laid.metrics.lifts);
  TravelTimes times;
  if (laid.motion == Motion::Stop) {
    const std::vector<double> no_dwell(laid.path.size(), 0.0);
    times.between_stops = program_of(laid.path, no_dwell, laid.motion, max_feed).total_seconds();
  }
  if (machine.machine) times.rests = lift_totals({{}, stroke_moves(laid.path, laid.motion).steps}, *machine.machine);
  double across = 0.0;  // as the program goes: from the end of a stroke to the beginning of the next
  for (std::size_t j = 1; j < laid.strokes.size(); ++j) {
    if (laid.path.lifted[j] != 0) across += distance(laid.strokes[j - 1].finish, laid.strokes[j].start);
  }
  times.lifted = (across + lift_height_mm * lifts) / max_feed;
  times.down = lift_height_mm * (lifts + 1.0) / max_feed;
  return times;
}

}  // namespace dwell
