#pragma once

#include <string>
#include <vector>

#include "paths/feed/feed.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/machine_limits.h"
#include "runs/programs/feed_table.h"

namespace dwell {

/// The program for the machine: dwell times as feeds, with every number as the exported files hold it. Last of the four
/// values of a plan; program_of(table) gives its steps.
struct MachineProgram {
  FeedTable table;
  FeedSchedule feed;                // as the dwell times ask for it, before rounding
  std::vector<std::string> limits;  // that were reached, one sentence each
};

/// Turns dwell times into a program. Throws InputError as feed_table_of. Cost O(points).
MachineProgram make_machine_program(const LaidPath& laid, const DwellPlan& dwell, const MachineLimits& machine,
                                    const Progress& progress = {});

/// The time of the rapids [s], which the program does not say: up by the lift height, and across, at the maximum feed.
/// The way down is a feed move of the program.
double lift_seconds(const PathMetrics& metrics, double lift_height_mm, const MachineLimits& machine);

}  // namespace dwell
