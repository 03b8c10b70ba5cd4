#pragma once

#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/gcode_reading.h"
#include "runs/programs/speed_gcode_words.h"

namespace dwell {

/// Reads a program of the dialect (docs/formats.md). What is plain G-code in it is read as read_gcode does, in mm and
/// mm/min; steps at work have their speeds. In G293 a block runs from the speed before it, 0 after a rest, to its F,
/// kFeedOfRest and less being rest, at constant acceleration. After FLIN it does so linearly over the path, and after
/// FNORM at one feed, which is reached from rest, or left for it, at the acceleration that a comment says; such blocks
/// are several steps. Throws InputError as plain_gcode_of and read_gcode, and naming file and line for: a speed that
/// jumps (a block without G293, or after FNORM, at another feed), a halt or a lift at a speed, or an exact stop; a
/// block of G293 that begins and ends at rest; FLIN from or to rest; an even block that does not reach its feed, or
/// leaves rest where no comment says the acceleration.
Program read_speed_gcode(std::string_view text, const std::string& file, SpeedDialect dialect,
                         const GcodeReading& reading, const Progress& progress = {});

}  // namespace dwell
