#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runs/programs/gcode.h"

namespace dwell {

/// Lines of G-code from a user's file, to be put into programs as they are.
struct GcodeInsert {
  std::string file;  // for messages; empty: none are given
  std::vector<std::string> lines;
};

/// Reads such a file. Throws InputError naming file, line and what is accepted: a line longer than kLongestLine, one
/// that is not printable ASCII, an end of the program (M2, M30, %).
GcodeInsert read_gcode_insert(const std::filesystem::path& file);

/// Checks that our own reader takes programs of these options with the lines `before` and `after` in them (and not in
/// options.style), that these remove as without, and that the tool is lifted at the end. `keep_path_mode`: also that
/// corners are taken as without. Throws InputError naming file, line and what is accepted.
void check_gcode_inserts(const GcodeInsert& before, const GcodeInsert& after, const GcodeOptions& options,
                         bool keep_path_mode);

}  // namespace dwell
