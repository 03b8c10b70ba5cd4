#pragma once

#include <Eigen/Core>

#include <vector>

#include "paths/feed/kinematic_path.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// Half a move, run at constant acceleration.
struct SpeedPiece {
  double length = 0.0;  // [mm]; 0 for halts, which do not count
  double reach = 0.0;   // 2 a L: most by which the squared speed changes [mm^2/s^2]; may be infinite
  Index stroke = StrokeMoves::kNoStroke;

  bool counts() const { return length > 0.0; }
};

/// The nodes at which a schedule of linear speeds says a speed: both ends of every move and its middle. Piece i goes
/// from node i to node i + 1; those of move k are 2 k and 2 k + 1.
struct SpeedNodes {
  std::vector<SpeedPiece> pieces;
  std::vector<double> cap;  // highest squared speed of every node [mm^2/s^2]; 0: the machine rests there
};

SpeedNodes speed_nodes(const StrokeMoves& moves, const KinematicPath& path);

/// Time of a piece between two squared speeds [s].
double time_between(const SpeedPiece& piece, double u, double next);

}  // namespace dwell
