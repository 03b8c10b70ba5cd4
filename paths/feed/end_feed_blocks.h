#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"

namespace dwell {

/// A block of a program whose feed is that at its end: a straight move, a halt, or a lifted way.
struct EndFeedBlock {
  Point start, finish;     // [mm]
  double seconds = 0.0;    // of halts; of other blocks it follows from the speeds
  bool removes = true;     // false: a lifted way, whose time is the machine's
  double speed_in = 0.0;   // along the path at its beginning; 0: at rest [mm/s]
  double speed_out = 0.0;  // at its end
  /// Run at one commanded feed, the larger of the two speeds, and not linearly from one to the other; an end at rest is
  /// left or reached at the machine's own acceleration.
  bool even = false;

  double length() const { return distance(start, finish); }
  bool halts() const { return removes && start == finish; }
};

/// The blocks of a motion whose every step at work is a halt, or straight at constant acceleration: one each; a
/// straight lifted way, in one step or several, is one without its time. Throws InputError naming `export`, the step
/// and what is required: a cubic that is bent or whose acceleration changes (`schedule` = pvt), a lifted way or a halt
/// that is reached at a speed. Cost O(steps).
std::vector<EndFeedBlock> blocks_of_motion(const Program& motion, const Progress& progress = {});

/// A straight step at constant acceleration between two speeds, not both 0.
ProgramStep accelerated_step(Point start, Point finish, double speed_in, double speed_out);

/// Gives steps of one direction, but for the rounding of their places, one velocity where they meet, which then does
/// not jump.
void join_rounded_directions(Program& program);

}  // namespace dwell
