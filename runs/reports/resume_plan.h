#pragma once

#include <string>

#include "core/base/progress.h"
#include "runs/base/output_folder.h"
#include "runs/job/job_options.h"
#include "runs/job/planned_job.h"

namespace dwell {

/// The surface that a stopped program left, in the folder of the plan of its rest.
inline constexpr const char* kRemainingMap = "remaining.npy";
inline constexpr const char* kRemainingSidecar = "remaining.npy.json";

/// The rest of a program that was stopped, as a plan of its own. `stop` is the line of program.nc in which it stopped,
/// "1234", its block number, "N1234", or the file of the controller's log of the stopped run. `options` are those of
/// the plan in the folder options.log_plan, with `out` and what else may differ: limits, threads, figures, how the log
/// is to be read.
///
/// What the blocks before the stop removed, by simulation as the plan's machine runs them, or as the log recorded them,
/// is taken off the plan's map: that is the map of the new plan, which is written into `folder` (kRemainingMap). The
/// rest of the path keeps its dwell (rest_of_path); a block that a line names counts as not run. The plan is
/// self-contained: `dwell simulate` of its folder works as of any other.
///
/// Throws InputError for a stop outside of the work, a log that does not lie on the program, a plan with a schedule of
/// speeds, files that have changed since; Interrupted. Cost: a simulation, and keep_dwell.
PlannedJob resume_plan(const std::string& stop, const JobOptions& options, const OutputFolder& folder,
                       const Progress& progress);

}  // namespace dwell
