#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dwell {

/// What a G or M code, or another word, does to a program as it is read here.
enum class GcodeEffect {
  None,         // moves nothing and changes no time, whatever stands beside it
  Cancel,       // ends what is refused itself; alone on its line, since beside X, Y or Z controllers disagree on it
  Motion,       // G0, G1
  Halt,         // G4
  Distance,     // G90, G91
  FeedMode,     // G93, G94
  Inches,       // G20: coordinates and feeds
  Millimetres,  // G21 and its like
  WorkOffset,   // G54 and its like: one of them a program
  PathMode,     // how the ends of moves are run, G64 with P and Q
  Pause,        // the machine waits for its operator
  End,          // of the program
  Spindle,      // on, off, its sense
  Coolant,      // on, off
  ToolChange,   // M6
  Refused,      // would change what the program means; `about` says how
};

/// A code: a letter and its number in tenths, G59.1 being {'G', 591}.
struct GcodeCode {
  char letter;
  int tenths;
  GcodeEffect effect;
  std::string_view about;  // what it does, for messages and documents
};

/// Every G and M code that is known, refused ones too: RS274/NGC and LinuxCNC, Fanuc and Haas, Sinumerik. A code that
/// is not in the table is refused as unknown, so that none is skipped.
std::span<const GcodeCode> gcode_codes();

/// The code of a letter and a number; null if it is not known. Numbers are compared to 1e-9.
const GcodeCode* gcode_code(char letter, double number);

/// What a word that is refused by its letter stands for ("a rotary axis"); empty if the letter is accepted or unknown.
std::string_view refused_letter(char letter);

/// The codes and words that are accepted, for messages: "accepted: G0 G1 ..., M2 ..., and F N ...".
const std::string& accepted_gcode();

}  // namespace dwell
