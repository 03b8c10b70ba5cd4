#include "runs/plan/least_dwell_of.h"

#include "paths/feed/kinematic_path.h"
#include "paths/feed/least_dwell.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

Eigen::VectorXd least_dwell_of(const LaidPath& laid, const MachineLimits& limits) {
  const FeedLimits feeds = limits.feed_limits();
  Eigen::VectorXd least = minimum_dwell(laid.strokes, feeds);
  if (!limits.machine) return least;
  const StrokeMoves moves = stroke_moves(laid.path, laid.motion);
  Eigen::VectorXd of_machine =
      least_dwell(moves, kinematic_path(moves.steps, *limits.machine, feeds.max_feed), *limits.machine);
  if (limits.learnt) of_machine += limits.learnt->late;
  return least.cwiseMax(of_machine);
}

}  // namespace dwell
