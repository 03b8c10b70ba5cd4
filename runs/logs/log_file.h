#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "runs/logs/log_columns.h"
#include "runs/logs/motion_log.h"

namespace dwell {

/// Reads a controller's log (docs/motion.md): text with any separator and a line that names the columns or none, an NPY
/// array, or an HDF5 data set (FILE.h5:/path), a row a sample. What is wrong with its clock is put right where that is
/// certain, and said (settle_clock). Throws InputError naming file, line, column, value and what is accepted;
/// Interrupted. Cost O(bytes).
MotionLog read_motion_log(const std::filesystem::path& file, const LogReading& reading = {},
                          const Progress& progress = {});

/// The same of text; `name` is the file for messages.
MotionLog parse_log_text(std::string_view text, const std::string& name, const LogReading& reading = {},
                         const Progress& progress = {});

}  // namespace dwell
