#pragma once

#include <Eigen/Core>

#include <vector>

#include "paths/feed/kinematic_path.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// Speeds at nodes with constant acceleration between them, as controllers run position-velocity-time tables and feeds
/// that are linear in time. Every move is cut in half, so that a stroke between two corners has a node at which the
/// tool is fast.
struct LinearSchedule {
  std::vector<double> speed;  // at the nodes: of move i, 2 i is its beginning, 2 i + 1 its middle; the last its end
  Eigen::VectorXd seconds;    // that every stroke takes [s]; of halts their dwell
  int steps = 0;              // of the minimiser
  double worst_error = 0.0;   // largest |seconds - dwell| / dwell
};

/// The speeds that bring every stroke's time nearest to its dwell [s]: with u the squared speeds, t_j the times,
///
///   minimise  sum_j (t_j - T_j)^2 / mean(T)^2 + eps sum_i ((u_(i+1) - u_i) / 2 a L)^2
///   subject to  u <= corner and speed limits,  |u_(i+1) - u_i| <= 2 a L.
///
/// The second term, small, ends a sawtooth that the times alone do not see. Gauss-Newton with logarithmic barriers,
/// banded (a stroke's time depends on at most five neighbouring nodes), fraction to the boundary 0.95, Armijo. dwell: n
/// values, finite, >= 0. Cost: 20 to 60 steps of O(moves).
LinearSchedule schedule_linear(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine,
                               const Eigen::VectorXd& dwell);

}  // namespace dwell
