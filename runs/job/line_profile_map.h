#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "runs/base/input_file.h"
#include "runs/job/job_options.h"

namespace dwell {

/// Refuses options that say how to read a map beside a line profile, and those of a line profile without one, by their
/// flags: none of them is skipped. Throws InputError.
void check_profile_options(const JobOptions& options);

/// The heights of a job's line profile without its form, as a map (runs/profile/profile_strip.h), prepared by the job's
/// map steps. All files read are appended to `inputs`; what the profile's form makes doubtful to `notes`, a sentence
/// each. Throws InputError, Interrupted.
HeightMap load_line_profile(const JobOptions& options, std::vector<InputFile>& inputs, std::vector<std::string>& notes,
                            const Progress& progress = {});

/// The options without what they say of a line profile, or of a map, for another in its place.
void forget_line_profile(JobOptions& options);
void forget_map(JobOptions& options);

}  // namespace dwell
