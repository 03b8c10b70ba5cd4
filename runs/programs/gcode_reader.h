#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/gcode_reading.h"

namespace dwell {

/// Interprets a G-code program (docs/formats.md lists the words) as the machine would: one step per line that moves
/// over the part or halts or, lifted, takes time. The tool is at work at Z = 0 (|Z| < 1e-9 mm) and lifted at Z > 0; a
/// move removes only if it is at work throughout. Rapids have seconds = 0. Moves without length are ignored in G94, and
/// so is what follows the end. After G20 coordinates and F are in inches; what is returned is in mm. Where the comment
/// "(dwell: zero=... rotate=... swap=...)" says how the program lies against the part (frame_text.h), the steps are in
/// the part's coordinates again. `reading` says what F means after G93, and P in G4, if the comment "(dwell: gcode=...,
/// g4=...)" does not; P with a decimal point is seconds. What the program left open is in the program's notes. Throws
/// InputError naming file, line, word and what is accepted: a word that is unknown or not honoured (gcode_codes.h); G1
/// without F or with F <= 0; G93 without its dialect, a move in it without its own F or without length; a whole number
/// of P whose unit is not known; a reading that contradicts the comment; a rapid over the part at work or at an unknown
/// height; work below Z = 0 or from an unknown position; another tool, spindle or coolant at work than before; a second
/// offset of the origin; a program without M2, M30 or the second %, or without steps. `file` is the name for messages.
Program read_gcode(std::string_view text, const std::string& file, const GcodeReading& reading,
                   const Progress& progress = {});

/// A program with the line on which each of its steps was read, from 1 on.
struct GcodeSteps {
  Program program;
  std::vector<std::size_t> lines;  // one a step
};

/// The same as read_gcode, for readers of dialects that say more of a step on its line.
GcodeSteps read_gcode_steps(std::string_view text, const std::string& file, const GcodeReading& reading,
                            const Progress& progress = {});

}  // namespace dwell
