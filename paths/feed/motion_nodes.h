#pragma once

#include <vector>

#include "core/base/point.h"

namespace dwell {

/// Where a machine is when a stretch of constant acceleration, or a rest, ends and the next begins.
struct MotionNode {
  double seconds = 0.0;  // on the clock of the motion
  Point place;           // [mm]
  double speed = 0.0;    // along the path [mm/s]
  bool removes = true;   // in the stretch that ends here
};

/// Puts the nodes of a motion together, one stretch after the other. Where the speed jumps (no acceleration is
/// considered, or the path turns at a corner that is taken at once) there are two nodes of one time.
class MotionNodes {
 public:
  void run(Point from, Point to, double speed_in, double speed_out, double seconds, bool removes);
  void rest(Point at, double seconds, bool removes) { run(at, at, 0.0, 0.0, seconds, removes); }
  std::vector<MotionNode> take();

 private:
  std::vector<MotionNode> nodes_;
};

}  // namespace dwell
