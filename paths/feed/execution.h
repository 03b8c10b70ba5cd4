#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/motion/program.h"
#include "paths/feed/machine.h"
#include "paths/feed/motion_nodes.h"

namespace dwell {

/// The motion that a machine makes of a program.
struct Execution {
  /// Steps so short that each may count as one at constant speed: where the machine accelerates, a step of the program
  /// is cut into several, and the arcs of a machine that blends are chords within 1e-4 mm of them. Their seconds are
  /// exact. Rapids have the time that the machine takes for them, but for the
  /// way up, which is left in motion.rapid_length.
  Program motion;
  /// Of every step of the program, rests at exact stops halved between their two steps; where the machine blends, from
  /// the middle of one arc to that of the next. The rests at lifts (LiftRests) are steps of the motion and in none of
  /// these.
  std::vector<double> seconds;
  std::vector<std::size_t> at_lifts;  // which steps of the motion are those rests, ascending
  double max_speed = 0.0;             // reached at work [mm/s]
  double max_acceleration = 0.0;      // along the path, at work [mm/s^2]
};

/// Runs a program's steps on a machine: each as a trapezoid of speed from its entry to its exit with the commanded feed
/// = length / seconds between (of rapids, which say none, the machine's maximum, or else the program's fastest), the
/// speeds at the nodes as node_speeds_squared looks ahead, corners, delays and lifts as the machine takes them. A
/// program that says the speeds at the ends of its steps is run as it stands, with the rests at lifts, which it does
/// not say. Throws InputError as kinematic_path, Interrupted. Cost O(steps).
Execution execute(const Program& program, const Machine& machine, const Progress& progress = {});

/// The nodes of the same motion, from the first step's start on: between two of them the machine moves straight at
/// constant acceleration, or rests; along a cubic or an arc, where it does not, nodes are so close that it may count as
/// doing so. Ways up and down are no part of it and the clock stands still, but for the rests at lifts. Throws as
/// execute. Cost O(steps).
std::vector<MotionNode> motion_nodes(const Program& program, const Machine& machine, const Progress& progress = {});

}  // namespace dwell
