#pragma once

#include "core/motion/program.h"
#include "core/numerics/plane_transform.h"

namespace dwell {

/// The program with every place, and the velocities of its cubic moves, moved by a transform: what a machine that lies
/// otherwise than thought makes of it. The times stay. Cost O(steps).
Program moved_program(Program program, const PlaneTransform& transform);

}  // namespace dwell
