#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/tif/removal_function.h"
#include "runs/base/input_file.h"
#include "runs/job/job_options.h"

namespace dwell {

/// Reads the map of a job, prepares it by the job's steps (runs/map_steps/map_steps.h) and appends all files read to
/// `inputs`. Throws InputError, Interrupted.
HeightMap load_map(const JobOptions& options, std::vector<InputFile>& inputs, const Progress& progress = {});

/// Reads or makes the removal function of a job; a file is appended to `inputs`. Throws InputError.
RemovalFunction load_removal_function(const JobOptions& options, std::vector<InputFile>& inputs);

}  // namespace dwell
