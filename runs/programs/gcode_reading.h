#pragma once

#include <optional>
#include <string>

#include "core/base/point.h"
#include "core/motion/axis_letters.h"
#include "runs/programs/gcode_dialect.h"
#include "runs/programs/program_template.h"

namespace dwell {

/// The unit of P in a halt, G4 P500. Controllers disagree: seconds (RS274/NGC, LinuxCNC) or whole milliseconds (Fanuc,
/// Haas, Sinumerik in ISO mode).
enum class HaltUnit { Seconds, Milliseconds };

/// Parses "s" or "ms". Throws InputError naming the text and the accepted words.
HaltUnit parse_halt_unit(const std::string& text);
std::string to_string(HaltUnit unit);

/// What a program may leave to its controller, as the user says it. What a program says itself, in its comment
/// "(dwell: gcode=..., g4=...)", must agree. `dialect` and `halts` are of G-code, `start` is of other programs.
struct GcodeReading {
  std::optional<GcodeDialect> dialect = {};  // what F means after G93
  std::optional<HaltUnit> halts = {};
  /// Where a program begins that says relative places alone, or none before its first move [mm].
  std::optional<Point> start = {};
  AxisLetters letters = {};  // of the machine's axes, in programs that name axes
  /// By which the program is read, whatever its content looks like.
  std::optional<ProgramTemplate> layout = {};
};

}  // namespace dwell
