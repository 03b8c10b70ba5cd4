#pragma once

#include <Eigen/Core>

#include "paths/feed/kinematic_path.h"
#include "paths/feed/machine.h"
#include "paths/feed/stroke_moves.h"

namespace dwell::bench {

/// Dwell times on a raster for a machine, to be turned into feeds or speeds.
struct ScheduleCase {
  Machine machine;
  StrokeMoves moves;
  KinematicPath path;
  Eigen::VectorXd dwell;  // [s]
};

/// About so many strokes of 1 mm in lines of 1000, on a machine of 50 mm/s and 500 mm/s^2 that stops at corners. The
/// dwell is in slow waves of 0.05 to 0.15 s; a rough one changes from stroke to stroke by up to half besides.
ScheduleCase make_schedule_case(long strokes, bool rough);

}  // namespace dwell::bench
