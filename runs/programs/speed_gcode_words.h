#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/motion/axis_letters.h"

namespace dwell {

/// G-code of two controllers in which F is a feed at the end of a block, that the machine reaches linearly.
enum class SpeedDialect {
  G293,  // over time: Beckhoff TwinCAT CNC (ISG kernels), G293 after #SLOPE [TYPE=STEP]
  Flin,  // over the path: Siemens 840D, FLIN
};

/// As comments and options name it: "g293", "flin".
std::string_view to_string(SpeedDialect dialect);

/// F of a rest in G293, which takes none of 0 [mm/min]: 0.001 mm/s.
inline constexpr double kFeedOfRest = 0.06;

/// Accelerations of a machine from rest [mm/s^2], of the axes as the program names them and along the path.
struct RestAccelerations {
  double x = std::numeric_limits<double>::infinity(), y = std::numeric_limits<double>::infinity();
  double path = std::numeric_limits<double>::infinity();

  bool are_said() const { return x < kNone || y < kNone || path < kNone; }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
};

/// What a line says beside plain G-code.
struct SpeedLine {
  bool ramps = false;  // G293 on it, or FLIN in force
  bool stops = false;  // at rest at its end: G60 of G293's controllers, G9 of FLIN's
};

/// A program without the words of its dialect.
struct SpeedText {
  std::string plain;              // as plain G-code, G94 and P of G4 in seconds, every line in its place
  std::vector<SpeedLine> lines;   // of every line
  RestAccelerations from_rest{};  // as a comment of FLIN says them
};

/// Whether a text is a program of the dialect: its words outside comments, or our comment "dwell: gcode=g293".
bool is_speed_gcode(std::string_view text, SpeedDialect dialect);

/// Takes the words of a dialect out of a program, `letters` being the machine's axes, so that a reader of plain G-code
/// takes the rest. Throws InputError naming file, line and what is accepted: words that mean something else on the
/// dialect's controllers than in plain G-code (G20 and G21 of Beckhoff mirror), G293 before #SLOPE [TYPE=STEP], FLIN
/// before COMPOF and G64, exact stops at every block (G60) of Siemens, comments that say another dialect. Cost O(text).
SpeedText plain_gcode_of(std::string_view text, const std::string& file, SpeedDialect dialect, AxisLetters letters = {},
                         const Progress& progress = {});

/// What a comment says of the accelerations from rest: "from rest at x 450, path 500 mm/s^2".
std::string rest_accelerations_text(const RestAccelerations& accelerations);

}  // namespace dwell
