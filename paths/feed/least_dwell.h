#pragma once

#include <Eigen/Core>

#include "paths/feed/kinematic_path.h"
#include "paths/feed/stroke_moves.h"

namespace dwell {

/// The rests with the tool down, as every stroke has of them [s]: a stop inside a stroke is the stroke's, one between
/// two strokes is shared by them, and where the tool comes down it settles in the stroke that begins there. n values.
Eigen::VectorXd rests_of_strokes(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine);

/// The shortest time of every stroke on a machine [s], n values: with all moves as fast as speeds, accelerations and
/// corners allow. A lower bound of every stroke's dwell; all strokes can have it at once. Halts have what the block
/// rate asks for. Cost O(moves).
Eigen::VectorXd least_dwell(const StrokeMoves& moves, const KinematicPath& path, const Machine& machine);

}  // namespace dwell
