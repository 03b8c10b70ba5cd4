#pragma once

#include <filesystem>
#include <optional>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/gcode_dialect.h"

namespace dwell {

/// Reads a machine program by its content: a feed table (its first line that is not blank begins with "# dwell" or is
/// the column line; runs/programs/feed_table.h) or else G-code (runs/programs/gcode_reader.h). `dialect` is for G-code
/// with G93 whose header does not say what F means. Throws InputError as those readers do, for a dialect given with a
/// feed table, and for a file that is empty or begins like neither.
Program read_program(const std::filesystem::path& file, std::optional<GcodeDialect> dialect = std::nullopt,
                     const Progress& progress = {});

}  // namespace dwell
