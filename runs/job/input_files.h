#pragma once

#include <string>
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

/// The flags of the pitches that a job lacks since neither its files nor its options say them. Reads map and removal
/// function for it: for messages that name all that is missing at once.
std::vector<std::string> missing_pitches(const JobOptions& options);

/// Reads or makes the removal function of a job; all files read are appended to `inputs`. A file of rates is prepared
/// by the job's steps, and questioned (core/tif/tool_questions.h): what is doubtful is refused unless an option answers
/// it. Throws InputError, Interrupted.
RemovalFunction load_removal_function(const JobOptions& options, std::vector<InputFile>& inputs,
                                      const Progress& progress = {});

}  // namespace dwell
