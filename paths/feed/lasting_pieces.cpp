#include "paths/feed/lasting_pieces.h"

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

/// The acceleration with which a change of speed takes at least so long.
double gentle(double acceleration, double change, double least_seconds) {
  return std::min(acceleration, std::abs(change) / least_seconds);
}

/// The length of a change of speed, 0 where there is none.
double ramp_length(double from, double to, double acceleration) {
  return from == to ? 0.0 : std::abs(to * to - from * from) / (2.0 * acceleration);
}

/// Changes of speed of at least so long at both ends of a move and the feed between; none if there is no room.
std::vector<MotionPiece> gentle_pieces(const Trapezoid& move, double v, double least_seconds) {
  const double up = ramp_length(move.speed_in, v, gentle(move.acceleration, v - move.speed_in, least_seconds));
  const double down = ramp_length(move.speed_out, v, gentle(move.acceleration, v - move.speed_out, least_seconds));
  std::vector<MotionPiece> pieces;
  if (up + down > move.length || !(v > 0.0)) return pieces;
  if (up > 0.0) pieces.push_back({up, move.speed_in, v});
  if (move.length - up - down > 0.0) pieces.push_back({move.length - up - down, v, v});
  if (down > 0.0) pieces.push_back({down, v, move.speed_out});
  return pieces;
}

}  // namespace

std::vector<MotionPiece> lasting_pieces(const Trapezoid& move, double feed, double least_seconds) {
  const double v = std::clamp(feed, std::max(move.speed_in, move.speed_out), peak_speed(move));
  std::vector<MotionPiece> pieces = gentle_pieces(move, v, least_seconds);
  if (pieces.empty()) {
    pieces = pieces_at_feed(move, feed);
    const bool lasting = std::all_of(pieces.begin(), pieces.end(),
                                     [=](const MotionPiece& piece) { return piece.seconds() >= least_seconds; });
    if (!lasting && move.speed_in + move.speed_out > 0.0) {
      pieces = {{move.length, move.speed_in, move.speed_out}};  // the peak between the ends is hardly higher
    } else if (!lasting) {                                      // from rest to rest
      const double peak = move.length / least_seconds;
      pieces = {{0.5 * move.length, 0.0, peak}, {0.5 * move.length, peak, 0.0}};
    }
  }
  // A short stretch at one speed goes to the pieces beside it, which then accelerate less.
  for (std::size_t k = 0; k < pieces.size() && pieces.size() > 1; ++k) {
    if (pieces[k].speed_in != pieces[k].speed_out || pieces[k].seconds() >= least_seconds) continue;
    const double length = pieces[k].length;
    const bool before = k > 0, after = k + 1 < pieces.size();
    if (before) pieces[k - 1].length += before && after ? 0.5 * length : length;
    if (after) pieces[k + 1].length += before && after ? 0.5 * length : length;
    pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(k));
    break;
  }
  return pieces;
}

}  // namespace dwell
