#pragma once

#include "core/motion/program.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/linear_schedule.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// The steps of a path with the speeds of a schedule, each at constant acceleration: two for every move of a stroke,
/// halts with their dwell, rests at exact stops, and moves without a stroke (lifted ones, those between stops) as fast
/// as the machine can, from the speed of one end to that of the other. All steps say their time. Cost O(moves).
Program linear_program(const StrokeMoves& moves, const KinematicPath& path, const LinearSchedule& schedule,
                       const Machine& machine);

}  // namespace dwell
