#pragma once

#include <vector>

#include "core/base/grid.h"
#include "core/motion/motion.h"
#include "core/motion/program.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// The moves and halts of a laid path in the order of the run. A stroke is one straight move or, where it turns at its
/// dwell point, two.
struct StrokeMoves {
  static constexpr Index kNoStroke = -1;

  std::vector<ProgramStep> steps;  // seconds are left at 0
  std::vector<Index> stroke;       // of each step; kNoStroke for moves between stops and lifted ones
  std::vector<double> share;       // of its stroke's length (of its time, at one speed); 1 for halts, 0 without stroke
  std::vector<double> length;      // of each stroke [mm]
  Index strokes = 0;

  std::size_t size() const { return steps.size(); }
};

/// Moving: a stroke is two moves, start -> via -> finish, or one where via lies within 2e-6 mm of the segment start ->
/// finish (a straight stroke whose coordinates were rounded to 1e-6 mm does so, and so does a stroke with an empty
/// half); a halt where it has no length. Stop: a halt at each point, and a move at work between points. Both: a lifted
/// move where the path is cut. Consecutive steps are chained exactly. Cost O(points). Throws InputError as
/// validate(path).
StrokeMoves stroke_moves(const ToolPath& path, Motion motion);

/// The strokes of a path under a motion: moving_strokes or halting_strokes.
std::vector<Stroke> strokes_of(const ToolPath& path, Motion motion);

}  // namespace dwell
