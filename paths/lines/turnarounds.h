#pragma once

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/motion/tool_path.h"
#include "paths/lines/scan_lines.h"

namespace dwell {

/// How the tool goes from the end of a line to the start of the next.
enum class Turnaround {
  Square,  // straight from end to start
  Arc,     // on a half circle outside the ends
  Lift,    // lifted
};

struct TurnOptions {
  Turnaround turn = Turnaround::Square;
  double corner = 0.0;  // corners are rounded with this radius [mm] (round_corners); finite, >= 0; 0 = not
};

/// The keys "turn" and "corner" of a planner's text.
TurnOptions parse_turn_options(const SpecText& spec);

/// Throws InputError naming the planner if the corner is out of range, or if turns are arcs but the lines are not run
/// as a serpentine.
void check_turn_options(const TurnOptions& turns, bool serpentine, const char* planner);

/// Most dwell points that a half circle between lines `distance` apart takes; possibly infinite.
double most_points_on_arc(const TurnOptions& turns, double distance, double step);

/// In which order and sense lines are run.
struct LineOrder {
  bool serpentine = true;        // every other line backwards; false = one-way, each line entered lifted
  bool from_last_line = false;   // the last line first
  bool first_backwards = false;  // the first line from its last point to its first
};

/// Runs the lines one after the other, and appends them to the path. The first line is entered lifted. So is every line
/// that follows a line without a wanted point, and every line if the turn is Lift or the order is one-way.
///
/// Turnaround::Arc joins a line to the next by a half circle whose diameter is their distance. It begins level with the
/// end that lies farther out; the other line is extended straight on to there, with dwell points at its own positions.
/// On the half circle, dwell points lie in the middles of equal parts: at least six, otherwise as many as bring them
/// nearest to the step. So the tool turns by at most 30 degrees at a time, and no move of a link is longer than 13/12
/// of the step. A link goes beyond the ends of the two lines by half of their distance.
void append_lines(ToolPath& path, const ScanLines& lines, const LineOrder& order, const TurnOptions& turns,
                  const Progress& progress = {});

}  // namespace dwell
