#pragma once

#include <limits>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/machine.h"

namespace dwell {

/// A straight move with what the machine can do along it, or a halt (length 0).
struct KinematicMove {
  double length = 0.0;        // [mm]
  double max_speed = 0.0;     // [mm/s]
  double acceleration = 0.0;  // [mm/s^2]
};

/// Moves one after the other. Move i goes from node i to node i + 1.
struct KinematicPath {
  std::vector<KinematicMove> moves;
  std::vector<double> corner;  // highest squared speed at every node [mm^2/s^2]; 0 = the machine comes to rest
  std::vector<char> stops;     // of every node: exact stops, where the machine's corner delay goes by

  std::size_t size() const { return moves.size(); }
};

/// The moves of consecutive steps on a machine. It rests at the beginning, at the end, at halts and where the tool is
/// lifted or lowered. Between two moves that turn by more than rounding explains, the squared speed is at most a d s /
/// (1 - s) with a the lesser acceleration, d the junction deviation and s the sine of half the angle between the moves
/// (Jeon 2011, "Improving Grbl: cornering algorithm"), 0 for an exact stop. Cost O(steps).
/// `max_feed`: of the program [mm/s], where it is less than the machine's. Moves at work are slow enough for the
/// controller's block rate (least_block_seconds).
KinematicPath kinematic_path(const std::vector<ProgramStep>& steps, const Machine& machine,
                             double max_feed = std::numeric_limits<double>::infinity());

/// The same for a program, whose path modes come before the machine's corner rule: with an exact path (G61) it rests
/// where two moves meet at an angle, with exact stops (G61.1) at the end of every move. Throws InputError for a path
/// that the controller blends (G64): where the tool then goes is not in the program. The axes are those of the
/// program's file (machine_on).
KinematicPath kinematic_path(const Program& program, const Machine& machine);

/// The highest squared speed at every node [mm^2/s^2] for a highest speed on every move (`feed`; taken as at most the
/// move's own): what corner and both feeds allow, reached by constant acceleration from both neighbours (a pass forward
/// and one back, as controllers look ahead). Cost O(moves).
std::vector<double> node_speeds_squared(const KinematicPath& path, const std::vector<double>& feed);

}  // namespace dwell
