#include "paths/feed/least_dwell.h"

#include "paths/feed/lift_rests.h"

namespace dwell {

Eigen::VectorXd rests_of_strokes(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine) {
  Eigen::VectorXd delay = settling_of_strokes(moves, machine);
  if (machine.corner_delay == 0.0) return delay;
  for (std::size_t i = 1; i < moves.size(); ++i) {
    if (path.stops[i] == 0) continue;
    for (const Index j : {moves.stroke[i - 1], moves.stroke[i]}) {
      if (j != StrokeMoves::kNoStroke) delay[j] += 0.5 * machine.corner_delay;
    }
  }
  return delay;
}

Eigen::VectorXd least_dwell(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine) {
  std::vector<double> fastest;
  fastest.reserve(path.size());
  for (const KinematicMove& move : path.moves) fastest.push_back(move.max_speed);
  const std::vector<double> u = node_speeds_squared(path, fastest);
  Eigen::VectorXd least = rests_of_strokes(moves, path, machine);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const KinematicMove& move = path.moves[i];
    if (moves.stroke[i] == StrokeMoves::kNoStroke) continue;
    if (!(move.length > 0.0)) {
      least[moves.stroke[i]] += least_block_seconds(machine);
      continue;
    }
    least[moves.stroke[i]] += move_parts(path, i, move.max_speed, u[i], u[i + 1]).seconds(move.max_speed);
  }
  return least;
}

}  // namespace dwell
