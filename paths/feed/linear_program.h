#pragma once

#include "core/motion/program.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/linear_schedule.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// The steps of a path with the speeds of a schedule, each at constant acceleration: two for every move of a stroke,
/// halts with their dwell, rests at exact stops, and moves without a stroke (lifted ones, those between stops) as fast
/// as the machine can, from the speed of one end to that of the other. All steps say their time; the rests at lifts
/// (LiftRests) are the machine's, and no steps. Moves without a stroke have no pieces shorter than `least_seconds`
/// (lasting_pieces). Cost O(moves).
Program linear_program(const StrokeMoves& moves, const KinematicPath& path, const LinearSchedule& schedule,
                       const Machine& machine, double least_seconds = 0.0);

/// Gives every node of a program with speeds one velocity, as tables of position, velocity and time have it: where two
/// steps meet at an angle and not at rest, the mean of both, so that the cubics round the corner. Times stay as they
/// are. Cost O(steps).
void join_velocities(Program& program);

}  // namespace dwell
