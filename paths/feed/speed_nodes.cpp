#include "paths/feed/speed_nodes.h"

#include <algorithm>
#include <cmath>

namespace dwell {

SpeedNodes speed_nodes(const StrokeMoves& moves, const KinematicPath& path) {
  SpeedNodes nodes;
  nodes.pieces.reserve(2 * moves.size());
  nodes.cap.reserve(2 * moves.size() + 1);
  double before = 0.0;  // highest squared speed of the move before
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const KinematicMove& move = path.moves[i];
    const double half = 0.5 * move.length, highest = move.length > 0.0 ? move.max_speed * move.max_speed : 0.0;
    for (int k = 0; k < 2; ++k) nodes.pieces.push_back({half, 2.0 * move.acceleration * half, moves.stroke[i]});
    nodes.cap.push_back(std::min(path.corner[i], i > 0 ? std::min(before, highest) : highest));
    nodes.cap.push_back(highest);
    before = highest;
  }
  nodes.cap.push_back(path.corner.back());
  return nodes;
}

double time_between(const SpeedPiece& piece, double u, double next) {
  return piece.counts() ? 2.0 * piece.length / (std::sqrt(u) + std::sqrt(next)) : 0.0;
}

}  // namespace dwell
