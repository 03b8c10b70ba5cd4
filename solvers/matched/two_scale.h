#pragma once

#include "core/base/grid.h"
#include "core/removal/removal_operator.h"

namespace dwell {

/// Sums over cubic B-splines on a lattice and on one twice as coarse. B3(u) = sum_i h_i B3(2u - i) with h = 1/8, 4/8,
/// 6/8, 4/8, 1/8 at i = -2 .. 2, so that what stands on the nodes of the fine lattice (c_i = sum_j B3((p_j - x_i) /
/// pitch) t_j) says exactly what stands on those of the coarse one. Cost about ten multiply-adds a fine node.
class TwoScale {
 public:
  /// origin: a point of both lattices, from which the coarse one counts its lines.
  TwoScale(const Grid& fine, Point origin);

  /// Nodes on every second line, counted from the origin, as far as the fine nodes reach.
  const Grid& coarse() const { return coarse_; }
  void restrict_to(const Vector& fine, Vector& coarse);
  /// The transpose.
  void prolong(const Vector& coarse, Vector& fine);

 private:
  Grid fine_, coarse_;
  Index row_shift_ = 0, col_shift_ = 0;  // fine line of coarse line 0, in fine pitches from the first fine line
  Vector rows_;                          // coarse rows x fine columns
};

}  // namespace dwell
