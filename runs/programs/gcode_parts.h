#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/gcode.h"
#include "runs/programs/gcode_reading.h"
#include "runs/programs/stretches.h"

namespace dwell {

/// The name of the list of a G-code program's parts, and what these are called as a format.
inline constexpr std::string_view kGcodePartsFile = "program_parts.csv";
inline constexpr std::string_view kGcodePartsWord = "parts";

/// A G-code program in files of at most `most_lines` lines each, for controllers that take no more: their list first,
/// then program_001.nc, program_002.nc, ... Each stands alone: it begins as the whole program does, goes to where it
/// goes on with the tool lifted, and ends with the tool lifted. The cut is where the tool is lifted anyhow, else at the
/// sharpest turn of the last quarter, else where the lines end. `made` is what the list says of how it was made. Throws
/// InputError naming `max lines` if no step has room, and as gcode_text.
std::vector<WrittenProgram> written_gcode_parts(const Program& program, const GcodeOptions& options,
                                                std::size_t most_lines, const FeedTable& made,
                                                const Progress& progress = {});

/// Whether a text is such a list.
bool is_gcode_part_list(std::string_view text);

/// Reads a list and the programs that it names, which lie beside it, as one program: their steps, and between two of
/// them the lifted way, up by the lift that the list states and across. Throws InputError naming file, line and what is
/// accepted: another column, a name that is none of a file beside it, a file whose SHA-256 or number of lines is not
/// that of the list, parts in different frames, and as read_gcode.
Program parse_gcode_part_list(std::string_view text, const std::string& file, const GcodeReading& reading,
                              const ReadBeside& beside, const Progress& progress = {});

}  // namespace dwell
