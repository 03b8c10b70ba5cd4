#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/grid.h"
#include "core/removal/removal_operator.h"

namespace dwell {

/// What of a surface an objective sees: the linear map R from heights at m pixels [nm] to rows, which are the heights
/// themselves (if they are asked for), then the slopes along x, then those along y, from each pixel to its neighbour if
/// both are among the pixels [nm/mm = urad]. A row of slope along x between positions a and a + 1 is (z_(a+1) - z_a) /
/// pitch_x, the same slope as that of map statistics.
class SurfaceRows {
 public:
  /// pixels: linear indices in the grid of the map, ascending. Cost O(pixels).
  SurfaceRows(const Grid& map, const std::vector<Index>& pixels, bool with_heights);

  Index pixels() const { return pixels_; }
  Index rows() const { return heights() + pairs_x() + pairs_y(); }
  Index heights() const { return with_heights_ ? pixels_ : 0; }  // rows of them, which come first
  Index pairs_x() const { return static_cast<Index>(left_.size()); }
  Index pairs_y() const { return static_cast<Index>(below_.size()); }

  /// The two pixels of the k-th slope along x, then y: positions in the list of pixels, the second at the larger x (y).
  std::pair<Index, Index> pair(Index k) const;

  /// rows = R heights.
  void apply(const Vector& heights, Vector& rows) const;
  /// heights = R' rows.
  void apply_adjoint(const Vector& rows, Vector& heights) const;

 private:
  Index pixels_;
  bool with_heights_;
  double per_pitch_x_, per_pitch_y_;
  std::vector<Index> left_;                     // the right neighbour is the next of the pixels
  std::vector<std::pair<Index, Index>> below_;  // with the neighbour above
};

/// R A: a removal operator whose rows are those of R. Both must outlive it.
class RowsOfRemoval final : public RemovalOperator {
 public:
  RowsOfRemoval(RemovalOperator& removal, const SurfaceRows& rows);
  std::string name() const override { return removal_.name() + ", slopes of it"; }

 private:
  void do_apply(const Vector& t, Vector& rows) override;
  void do_apply_adjoint(const Vector& rows, Vector& t) override;

  RemovalOperator& removal_;
  const SurfaceRows& rows_;
  Vector heights_;
};

}  // namespace dwell
