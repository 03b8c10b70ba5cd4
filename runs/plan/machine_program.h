#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/feed.h"
#include "paths/feed/lift_rests.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/machine_limits.h"
#include "runs/programs/feed_table.h"

namespace dwell {

/// The program for the machine: dwell times as feeds, with every number as the exported files hold it. Last of the four
/// values of a plan; program_of(table) gives its steps.
struct MachineProgram {
  FeedTable table;
  FeedSchedule feed;                // as it is commanded, before rounding
  std::optional<Program> motion;    // as it is scheduled, where a format asks for it (ProgramToWrite)
  std::vector<std::string> limits;  // that were reached, one sentence each
};

/// Turns dwell times into a program. Throws InputError as feed_table_of, and for a program
/// that would hold no step. Cost O(points).
MachineProgram make_machine_program(const LaidPath& laid, const DwellPlan& dwell, const MachineLimits& machine,
                                    const Progress& progress = {});

/// The times of a run besides its dwell [s], all at the maximum feed. They depend on the path alone.
struct TravelTimes {
  double between_stops = 0.0;  // from halt to halt with the tool down; 0 where the tool runs through
  double lifted = 0.0;         // rapids, up by the lift height and across: the program does not say their time
  double down = 0.0;           // at the beginning and after each lift: feed moves of the program
  LiftTotals rests{};          // of the machine at lifts; settling is part of the dwell

  double total() const { return between_stops + lifted + down + rests.lift + rests.plunge; }
};

/// Cost O(points).
TravelTimes travel_times(const LaidPath& laid, double lift_height_mm, const MachineLimits& machine);

}  // namespace dwell
