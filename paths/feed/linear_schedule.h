#pragma once

#include <Eigen/Core>

#include <vector>

#include "core/base/progress.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// Speeds at nodes with constant acceleration between them, as controllers run position-velocity-time tables and feeds
/// that are linear in time. Every move is cut in half, so that a stroke between two corners has a node at which the
/// tool is fast.
struct LinearSchedule {
  std::vector<double> speed;  // at the nodes: of move i, 2 i is its beginning, 2 i + 1 its middle; the last its end
  Eigen::VectorXd seconds;    // that every stroke takes [s]; of halts their dwell
  Index windows = 0;          // stretches of the path in which the limits ask for more than the natural speeds
  int steps = 0;              // of the minimiser, most in one window
  double worst_error = 0.0;   // largest |seconds - dwell| / dwell
};

/// The speeds that bring every stroke's time nearest to its dwell [s]: with u the squared speeds, t_j the times,
///
///   minimise  sum_j (t_j - T_j)^2 / mean(T)^2 + eps sum_i ((u_(i+1) - u_i) / 2 a L)^2
///   subject to  u <= corner and speed limits,  |u_(i+1) - u_i| <= 2 a L.
///
/// The second term, small, ends a sawtooth that the times alone do not see. Most strokes need no minimiser: between the
/// mean speeds of neighbours at the ends, the speed in the middle follows from the dwell (natural speeds). Where these
/// break a limit, a window around is solved (SpeedMinimiser), whose ends keep the natural speeds. dwell: n values,
/// finite, >= 0. Windows run two at a time with more threads; the result does not depend on their number. Throws
/// Interrupted. Cost: O(moves), and 20 to 60 steps of O(moves in windows).
LinearSchedule schedule_linear(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine,
                               const Eigen::VectorXd& dwell, int threads = 1, const Progress& progress = {});

}  // namespace dwell
