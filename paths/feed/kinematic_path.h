#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/motion/program.h"
#include "paths/feed/blend_arc.h"
#include "paths/feed/machine.h"
#include "paths/feed/speed_change.h"
#include "paths/feed/trapezoid.h"

namespace dwell {

/// A straight move with what the machine can do along it, or a halt (length 0).
struct KinematicMove {
  double length = 0.0;                                    // [mm]
  double max_speed = 0.0;                                 // [mm/s]
  double acceleration = 0.0;                              // [mm/s^2]
  double jerk = std::numeric_limits<double>::infinity();  // [mm/s^3]

  SpeedChange change() const { return {acceleration, jerk}; }
};

/// Moves one after the other. Move i goes from node i to node i + 1.
struct KinematicPath {
  std::vector<KinematicMove> moves;
  std::vector<double> corner;  // highest squared speed at every node [mm^2/s^2]; 0 = the machine comes to rest
  std::vector<char> stops;     // of every node: exact stops, where the machine's corner delay goes by
  /// Of every node, those without radius included, where the machine blends; none where it does not. A node with an arc
  /// is the middle of it, and half of the arc belongs to each of its moves.
  std::vector<BlendArc> arcs{};
  double arc_jerk = std::numeric_limits<double>::infinity();  // along arcs [mm/s^3]

  std::size_t size() const { return moves.size(); }
};

/// The moves of consecutive steps on a machine. It rests at the beginning, at the end, at halts and where the tool is
/// lifted or lowered. Between two moves that turn by more than rounding explains, the squared speed is at most a d s /
/// (1 - s) with a the lesser acceleration, d the junction deviation and s the sine of half the angle between the moves
/// (Jeon 2011, "Improving Grbl: cornering algorithm"), 0 for an exact stop. With CornerRule::Blend there is an arc
/// (blend_arc) for the feeds that the steps' seconds command, or the machine's highest where they have none; moves that
/// turn back by more than 178 degrees meet at a stop. Cost O(steps).
/// `max_feed`: of the program [mm/s], where it is less than the machine's. Moves at work are slow enough for the
/// controller's block rate (least_block_seconds).
KinematicPath kinematic_path(const std::vector<ProgramStep>& steps, const Machine& machine,
                             double max_feed = std::numeric_limits<double>::infinity());

/// The same for a program, whose path modes come before the machine's corner rule: with an exact path (G61) it rests
/// where two moves meet at an angle, with exact stops (G61.1) at the end of every move, and blended (G64) it takes
/// arcs within the tolerance that the program says, or else that of a machine which blends. Throws InputError where
/// neither says one, and where rows of moves are merged (Q): where the tool then goes is not known. The axes are those
/// of the program's file (machine_on).
KinematicPath kinematic_path(const Program& program, const Machine& machine);

/// A move as up to three trapezoids between its nodes, for a feed and the squared speeds at the nodes: the half of the
/// arc at its start, what is straight, and the half of the arc at its end. Where the machine does not blend, the second
/// is all. Parts without length are left out by MoveParts::for_each.
struct MoveParts {
  std::array<Trapezoid, 3> part;

  double seconds(double feed) const;
  template <class Action>
  void for_each(const Action& action) const {
    for (std::size_t k = 0; k < part.size(); ++k) {
      if (part[k].length > 0.0) action(part[k], k);
    }
  }
};
MoveParts move_parts(const KinematicPath& path, std::size_t move, double feed, double u_in, double u_out);

/// The highest squared speed at the end of a move, at a feed, that is reached from one at its beginning [mm^2/s^2], and
/// the highest at its beginning from which it comes down to one at its end.
double reached_forward(const KinematicPath& path, std::size_t move, double feed, double u_in);
double reached_back(const KinematicPath& path, std::size_t move, double feed, double u_out);

/// The highest squared speed at every node [mm^2/s^2] for a highest speed on every move (`feed`; taken as at most the
/// move's own): what corner and both feeds allow, reached by the machine's changes of speed from both neighbours (a
/// pass forward and one back, as controllers look ahead). Cost O(moves).
std::vector<double> node_speeds_squared(const KinematicPath& path, const std::vector<double>& feed);

}  // namespace dwell
