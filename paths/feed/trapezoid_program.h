#pragma once

#include <vector>

#include "core/motion/program.h"
#include "paths/feed/machine.h"

namespace dwell {

/// The motion of a program on a machine, in as few steps as say it exactly, each with the velocities at its ends.
struct TrapezoidProgram {
  Program motion;
  std::vector<double> seconds;  // of every step of the program, rests at exact stops halved between their two steps
};

/// What execute() makes of a program, as pieces of constant acceleration: a cubic of time each, as tables of position,
/// velocity and time have them. No piece takes less than `least_seconds` where a move has room for that: a change of
/// speed then takes so long at a lower acceleration, and a stretch at one speed that is shorter becomes part of its
/// neighbours. With 0 the motion is that of execute(). Lifted moves are steps of their own, as fast as the machine can.
/// Throws InputError as kinematic_path, and for a machine that has no limit of acceleration, for then the speed jumps,
/// and for a machine that blends corners.
TrapezoidProgram trapezoid_program(const Program& program, const Machine& machine, double least_seconds = 0.0);

}  // namespace dwell
