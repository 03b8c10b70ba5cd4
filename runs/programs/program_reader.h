#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/gcode_reading.h"

namespace dwell {

/// Reads a machine program by its content: a feed table (its first line that is not blank begins with "# dwell" or is
/// the column line; runs/programs/feed_table.h) or else G-code (runs/programs/gcode_reader.h). `reading` is for G-code
/// that leaves something to its controller; a template in it reads the file, whatever its content. Throws InputError as
/// those readers do, for a reading given with a feed table, and for a file that is empty or begins like neither.
Program read_program(const std::filesystem::path& file, const GcodeReading& reading = {},
                     const Progress& progress = {});

}  // namespace dwell
