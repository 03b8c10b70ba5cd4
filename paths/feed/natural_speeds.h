#pragma once

#include <vector>

#include "paths/feed/speed_nodes.h"

namespace dwell {

/// The pieces of one stroke, [first, last): one after the other.
struct StrokePieces {
  std::size_t first = 0, last = 0;
  double length = 0.0;  // [mm]; 0 for halts
};

/// In the order of the run, n strokes.
std::vector<StrokePieces> pieces_of_strokes(const SpeedNodes& nodes, Index strokes);

/// Squared speeds of all nodes [mm^2/s^2] that keep all limits and that a path of smooth dwell has by itself.
struct NaturalSpeeds {
  std::vector<double> u;
  std::vector<char> holds;  // of every stroke: its time is its dwell (within 1e-9 of it)
};

/// Between two strokes the mean of their mean speeds (length / dwell), inside each stroke the one speed of its middle
/// nodes with which it takes its dwell; then lowered where a limit asks for it. dwell: of moving strokes [s], >= 0.
/// Cost O(pieces).
NaturalSpeeds natural_speeds(const SpeedNodes& nodes, const std::vector<StrokePieces>& strokes,
                             const Eigen::VectorXd& dwell);

}  // namespace dwell
