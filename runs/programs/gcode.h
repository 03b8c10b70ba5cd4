#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "paths/feed/machine.h"
#include "runs/programs/gcode_dialect.h"
#include "runs/programs/gcode_style.h"

namespace dwell {

struct GcodeOptions {
  GcodeDialect dialect = GcodeDialect::G94;
  double lift_height_mm = 10.0;      // Z of lifted moves, >= 1e-6; the tool is at work at Z = 0
  double max_feed_mm_per_min = 0.0;  // > 0; no F exceeds it, and the tool comes down to work at it
  std::vector<std::string> header;   // comments, as comment_text; at most kLongestComment characters each
  GcodeStyle style;
  /// Whose letters the axes have, of whose steps places and halts are multiples (each place by itself, halts in their
  /// sum, so that errors do not add up), and whose speeds no rounded move exceeds.
  std::optional<Machine> machine{};
};

/// The text of program.nc (docs/formats.md), in the program's frame: in ASCII, no line longer than kLongestLine. It
/// begins with the tool being lifted and ends with it lifted. Coordinates have 6 decimals, in inches 8; F is computed
/// from the rounded coordinates and rounded to the slow side in the ninth digit, so that a step takes its `seconds`
/// within 1e-6 relative, or longer where rounding made it longer than maximum feed allows. A removing step that
/// rounding leaves without length is a halt. Lifted moves are rapids, whose time the program does not say. Throws
/// InputError for an option out of range; std::logic_error if the program is no chain (a removing step that does not
/// start within 1e-9 mm of where the one before it ended), a header or style line is too long or not ASCII, a move
/// takes no time or runs above maximum feed, or a lifted step has a duration. Cost O(steps).
std::string gcode_text(const Program& program, const GcodeOptions& options, const Progress& progress = {});

}  // namespace dwell
