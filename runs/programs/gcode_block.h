#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/motion/axis_letters.h"
#include "core/motion/program.h"
#include "runs/programs/gcode_words.h"

namespace dwell {

/// What the words of one line of G-code ask for, each word known and accepted.
struct GcodeBlock {
  std::optional<double> x, y, z, f, s;  // in the unit that the program is in
  std::optional<GcodeWord> p;           // as written: a halt's unit may hang on its decimal point
  std::optional<int> motion;            // 0 or 1
  std::optional<bool> incremental;
  std::optional<int> feed_mode;    // 93 or 94
  std::optional<int> work_offset;  // in tenths: 540, 591
  std::optional<double> tool;
  std::optional<int> spindle;  // 3, 4 or 5
  bool mist = false, flood = false, coolants_off = false;
  bool numbered = false;  // O, the program's number
  bool change_tool = false, halt = false, pause = false, end = false;
  std::optional<bool> inches;         // or millimetres
  std::optional<PathMode> path_mode;  // its lengths likewise

  bool has_axes() const { return x || y || z; }
};

/// Collects the words of a line. Throws InputError that begins with the place and names the word and what is accepted:
/// a code or letter that is not known or would change what the program means (gcode_codes.h), a second word of its
/// kind, P, Q or axes beside a code that does not take them; an axis of the plane that is none of `letters`.
GcodeBlock collect_gcode_block(const GcodeLine& line, const GcodePlace& where, AxisLetters letters = {});

}  // namespace dwell
