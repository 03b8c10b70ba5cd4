#pragma once

#include "core/base/random_numbers.h"
#include "core/motion/program.h"
#include "core/numerics/plane_transform.h"

namespace dwell {

/// The program with every place, and the velocities of its cubic moves, moved by a transform: what a machine that lies
/// otherwise than thought makes of it. The times stay. Cost O(steps).
Program moved_program(Program program, const PlaneTransform& transform);

/// The program with every end of a move beside its place, in x and in y by `deviation` [mm] times normal numbers; a
/// halt stays where the move before it ended. The times stay. A negative deviation puts every end on the other side
/// with the same random numbers; none are drawn for zero. Cost O(steps).
Program jittered_program(Program program, double deviation, RandomNumbers& random);

}  // namespace dwell
