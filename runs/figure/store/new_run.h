#pragma once

#include <filesystem>
#include <string>

#include "core/base/progress.h"
#include "core/form/map_statistics.h"
#include "runs/acceptance/surface_limits.h"
#include "runs/figure/store/run_folder.h"
#include "runs/job/job_options.h"

namespace dwell {

/// What a run is made from: the options of its plans, with the map as it is before the first run.
struct NewRun {
  JobOptions options;  // without `out` and a log
  std::string target;  // limits that the plans steer for; empty: none
  std::string bands;   // wavelengths between bands [mm], for `mid`; empty: none
};

/// A run that was made, and the part that it begins with.
struct MadeRun {
  RunFolder folder;
  MapStatistics before;                  // form terms removed
  std::vector<SurfaceVerdict> verdicts;  // of the target
  RemovalFunction tif;
};

/// Makes the folder of a run: its first step holds the files that the options name, the job file that names them
/// there, and the map as it is read. All that can be refused is refused here, before a plan: map, tool, machine,
/// target. Throws InputError, Interrupted. Cost: reading the files.
MadeRun make_run(const std::filesystem::path& folder, const NewRun& run, const Progress& progress = {});

}  // namespace dwell
