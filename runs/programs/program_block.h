#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/gcode_reading.h"

namespace dwell {

/// A block of a G-code program, and the step of the program in it, or else the first one after it.
struct ProgramBlock {
  Program program;
  std::size_t line = 0;   // from 1 on
  std::size_t lines = 0;  // of the whole file
  std::size_t step = 0;   // index into the program's steps
};

/// Whether a text names a block: "1234", its line, or "N1234", the line that begins with this number.
bool is_program_block(const std::string& text);

/// Reads a G-code program and finds a block in it, at which it stopped. Throws InputError as read_gcode, and for a line
/// outside of the program, for one before the first step that removes or behind the last one, and for an N that no line
/// or several lines have: with the lines that are accepted.
ProgramBlock find_program_block(const std::filesystem::path& file, const std::string& block,
                                const GcodeReading& reading, const Progress& progress = {});

}  // namespace dwell
