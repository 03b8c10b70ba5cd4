#pragma once

#include <vector>

#include "core/motion/program.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/machine.h"

namespace dwell {

/// The feed that every step commands [mm/s], at most what the machine can: length / seconds, of rapids, which say none,
/// the machine's maximum, or else the program's fastest. Infinite where nothing says it. `path` is that of the program.
std::vector<double> commanded_feeds(const Program& program, const KinematicPath& path);

/// The time that a machine takes for every step of a program [s], rests at exact stops halved between their two steps:
/// execute(...).seconds, without the motion itself. A program that says
/// the speeds at the ends of its steps takes the times that it says. Throws
/// InputError as kinematic_path. Cost O(steps).
std::vector<double> step_times(const Program& program, const Machine& machine);

}  // namespace dwell
