#pragma once

#include <optional>
#include <string>

#include "runs/programs/gcode_block.h"

namespace dwell {

/// What of a machine makes its removal function, as far as a program says it. One removal function holds for one state:
/// what a program removes with can be simulated only if the state is the same whenever the tool is at work.
struct GcodeTool {
  std::optional<double> number;  // T
  int changes = 0;               // M6 so far
  std::optional<double> speed;   // S
  std::optional<int> spindle;    // 3, 4: clockwise, counter-clockwise; 5: off
  bool mist = false, flood = false;

  /// Takes what a line says.
  void take(const GcodeBlock& block);
};

/// In what the tool now is another than before, in words with both values ("the spindle's speed is S2000, before
/// S1000"); empty if in nothing.
std::string tool_difference(const GcodeTool& before, const GcodeTool& now);

}  // namespace dwell
