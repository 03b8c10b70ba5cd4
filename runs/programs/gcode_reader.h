#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "runs/programs/gcode_dialect.h"

namespace dwell {

/// Interprets a G-code program (docs/formats.md lists the words) as the machine would: one step per line that moves
/// over the part or halts or, lifted, takes time. The tool is at work at Z = 0 (|Z| < 1e-9 mm) and lifted at Z > 0; a
/// move removes only if it is at work throughout. Rapids have seconds = 0. Moves without length are ignored, and so is
/// what follows the end. `dialect` says what F means after G93, if the header comment "(dwell: gcode=...)" does not.
/// Throws InputError naming file, line, word and what is accepted: an unknown word; inches; G1 without F or with F <=
/// 0; G93 without its dialect, or a move without its own F; a dialect that contradicts the header; a rapid over the
/// part at work or at an unknown height; work below Z = 0 or from an unknown position; a program without M2 or M30, or
/// without steps. `file` is the name for messages.
Program read_gcode(std::string_view text, const std::string& file, std::optional<GcodeDialect> dialect,
                   const Progress& progress = {});

}  // namespace dwell
