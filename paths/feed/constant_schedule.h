#pragma once

#include <Eigen/Core>

#include <vector>

#include "paths/feed/kinematic_path.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// One feed a stroke, as plain G-code says it, compensated for what the controller makes of it.
struct ConstantSchedule {
  std::vector<double> feed;  // to command on every stroke [mm/s]; 0 for halts
  std::vector<double> halt;  // to command of every halt [s]: its dwell less what it settles; of strokes no matter
  Eigen::VectorXd seconds;   // that every stroke then takes [s]; of halts their dwell
  int rounds = 0;
  double worst_error = 0.0;  // largest |seconds - dwell| / dwell over strokes that could be held
  Index too_short = 0;       // strokes that take longer than their dwell even at the highest feed
};

/// Feeds with which a controller that accelerates as trapezoids, looks ahead and takes corners as the machine does
/// spends on every stroke its dwell [s]. For known speeds at the nodes the feed of a stroke follows from its dwell
/// (feed_for_time), and for known feeds the speeds at the nodes follow from two passes (node_speeds_squared): this is
/// repeated until both hold, from the fifth round on with half the change, which ends the swinging of strokes that hold
/// each other back. A stroke at a corner must be faster elsewhere. The arcs of a machine
/// that blends are as the path has them: where their size depends on the feeds, schedule_blended makes both. dwell: n
/// values, finite, >= 0. Cost: about 5 rounds of O(moves), and 20 of those that change.
ConstantSchedule schedule_constant(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine,
                                   const Eigen::VectorXd& dwell);

/// The same for a machine whose arcs are as large as the feeds need (BlendSize::AsNeeded): the path is made anew for
/// the feeds found on it, until no feed changes by more than 1e-6 of it, 10 times at most. For others one schedule on
/// the path of the moves. `max_feed` as in kinematic_path. Cost: schedule_constant a round.
ConstantSchedule schedule_blended(const StrokeMoves& moves, const Machine& machine, double max_feed,
                                  const Eigen::VectorXd& dwell);

}  // namespace dwell
