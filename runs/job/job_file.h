#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "runs/job/job_options.h"

namespace dwell {

/// The number of the layout that a job file states as `schema`. Version 0.1 of the program wrote layout 1, mostly
/// without saying so; its fields mean the same, and it is still read.
inline constexpr int kJobSchema = 2;

/// Reads a TOML job file over `options`. File names in it are relative to its folder. Throws InputError naming the
/// file, the line or field, the value and what is accepted; an unknown field is an error that lists the known ones.
void read_job_file(const std::filesystem::path& file, JobOptions& options);

/// Another name for a file.
using FileNames = std::function<std::string(const std::string&)>;

/// The value of an option with other names for the files in it: what `name` makes of each. `source` begins messages.
/// Throws InputError.
std::string renamed_option(const JobOptionRecord& record, const std::string& value, const FileNames& name,
                           const std::string& source);

/// The value of an option with the file names in it taken relative to a folder, and not to the current one; `source`
/// begins messages. Throws InputError.
std::string rebased_option(const JobOptionRecord& record, const std::string& value, const std::filesystem::path& folder,
                           const std::string& source);

/// A commented job file with the values of `options`; what is not given is left as a comment.
std::string job_file_text(const JobOptions& options);

}  // namespace dwell
