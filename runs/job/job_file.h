#pragma once

#include <filesystem>
#include <string>

#include "runs/job/job_options.h"

namespace dwell {

/// Reads a TOML job file over `options`. File names in it are relative to its folder. Throws InputError naming the
/// file, the line or field, the value and what is accepted; an unknown field is an error that lists the known ones.
void read_job_file(const std::filesystem::path& file, JobOptions& options);

/// A commented job file with the values of `options`; what is not given is left as a comment.
std::string job_file_text(const JobOptions& options);

}  // namespace dwell
