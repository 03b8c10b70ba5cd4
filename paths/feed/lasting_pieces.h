#pragma once

#include <vector>

#include "paths/feed/trapezoid.h"

namespace dwell {

/// The pieces of a move at a feed (pieces_at_feed), none shorter than `least_seconds` [s], > 0, where there is room: a
/// change of speed then takes so long at a lower acceleration, a stretch at one speed that is shorter becomes part of
/// its neighbours, and a move from rest to rest takes at least twice that. In tables whose places are rounded, shorter
/// ones would exceed the acceleration.
std::vector<MotionPiece> lasting_pieces(const Trapezoid& move, double feed, double least_seconds);

}  // namespace dwell
