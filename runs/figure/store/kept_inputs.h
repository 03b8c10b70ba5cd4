#pragma once

#include <filesystem>
#include <string>

#include "runs/base/output_folder.h"
#include "runs/job/job_options.h"

namespace dwell {

/// Copies every file that the options name into the folder, below `inputs/` by the key of its option, each with its
/// sidecar if it is an NPY array that has one, and gives the options with the names of the copies, as seen from the
/// folder: a run keeps what it was made from. `only`: options whose key begins so; empty = all. Throws InputError for a
/// file that is not there or cannot be copied.
JobOptions keep_inputs(JobOptions options, const OutputFolder& folder, const std::string& only = "");

/// Copies one more file into the folder, below `inputs/` by a key, and gives its name there. Throws InputError.
std::string keep_file(const std::filesystem::path& file, const std::string& key, const OutputFolder& folder);

/// The options with the names of their files as seen from another folder: relative to `to`, where they are as seen
/// from `from`. Both may be empty: the current one. Throws InputError.
JobOptions options_seen_from(JobOptions options, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace dwell
