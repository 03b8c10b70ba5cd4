#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "runs/base/input_file.h"
#include "runs/job/job_options.h"

namespace dwell {

/// A plan's folder as its summary.json tells of it.
struct RecordedPlan {
  std::filesystem::path folder;
  JobOptions options;             // all that were in force; no `out`; names of files as seen from the current folder
  std::vector<InputFile> inputs;  // likewise
  std::string program_sha256;

  std::string program_file;  // in the folder: program.nc, or what says a schedule of speeds

  /// The program that the machine runs.
  std::filesystem::path program() const { return folder / program_file; }
};

/// Reads a plan's folder. Relative names of files in it are those as seen from the folder in which the plan was made,
/// to which the summary says the way from the plan's folder; where none of the files is there, or the summary says no
/// way (version 0.2), as seen from the current folder. Throws InputError for a folder that does not exist or that
/// `dwell plan` did not write, naming what it is, and for a field that this version does not know.
RecordedPlan read_recorded_plan(const std::filesystem::path& folder);

/// Refuses a map, a map of a step, a removal function or a program that is not there or has changed since the plan was
/// made, by the SHA-256 of the summary.
/// What is given in the plan's place (`given`: flags, as "map", "tif", "map-steps", "program") is not looked at, and
/// neither is the path's file, which the program holds. Throws InputError naming the file, the option and both hashes.
void check_recorded_inputs(const RecordedPlan& plan, const std::set<std::string>& given);

}  // namespace dwell
