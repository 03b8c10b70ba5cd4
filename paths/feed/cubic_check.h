#pragma once

#include <string>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/machine.h"

namespace dwell {

/// What the steps of a program that say their speeds (tables of position, velocity and time) ask of a machine that it
/// cannot do, a sentence each: a speed or an acceleration of an axis or along the path above its limit anywhere on a
/// step, lifted ones included; a velocity that jumps between two steps, or is not 0 at the beginning or the end. Under
/// a limit of jerk a jump of the acceleration counts as the jerk that would take it up in the shorter of the steps
/// beside it. Within 1e-6 of the limits, those of the axes in the machine's frame. Empty if there is
/// nothing. Cost O(steps).
std::vector<std::string> cubics_beyond_machine(const Program& program, const Machine& machine);

}  // namespace dwell
