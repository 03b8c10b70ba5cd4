#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/tif/removal_function.h"
#include "runs/base/input_file.h"
#include "runs/job/job_options.h"

namespace dwell {

/// "middle", "centroid" or "X,Y" [mm].
TifCentre parse_tif_centre(const std::string& text);
/// "X,Y" [mm], both finite.
Point parse_point(const std::string& text);

/// Reads the map of a job, prepares it by the job's steps (runs/map_steps/map_steps.h) and appends all files read to
/// `inputs`. Throws InputError, Interrupted.
HeightMap load_map(const JobOptions& options, std::vector<InputFile>& inputs, const Progress& progress = {});

/// Reads or makes the removal function of a job; a file is appended to `inputs`. Throws InputError.
RemovalFunction load_removal_function(const JobOptions& options, std::vector<InputFile>& inputs);

/// Throws InputError if the tool is wider than the map both ways: nearly always a wrong pitch or unit of length.
void check_tool_fits(const RemovalFunction& tif, const Grid& map);

}  // namespace dwell
