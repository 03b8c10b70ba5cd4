#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// Euclidean distance [mm] from any point of the plane to the nearest valid (finite) pixel centre of a map, exact to
/// rounding also between pixels and for pitches that differ in x and y.
///
/// Prepared once: distances at the nodes of the map's grid, extended by `margin` on all sides, by lower envelopes of
/// parabolas (Felzenszwalb and Huttenlocher 2012, "Distance transforms of sampled functions", section 2); cost and
/// memory O(nodes). By the triangle inequality, the distance at a node bounds those of the points around it; a query
/// that these bounds do not decide searches the rows of pixels near its point.
class DistanceMap {
 public:
  /// margin [mm], finite and >= 0; it only makes queries faster, and is capped at the map's own extent, so that there
  /// are at most about nine nodes a pixel. Throws InputError if the map has no valid pixel.
  DistanceMap(const HeightMap& map, double margin, const Progress& progress = {});

  /// Distance from `p`. Cost O(distance / pitch_y + 1).
  double operator()(Point p) const;

  /// Whether operator()(p) <= reach. Cost O(1) except for points about as far as `reach` (to a pixel's diagonal).
  bool within(Point p, double reach) const;

  struct Bounds {
    double low, high;
  };
  /// Two numbers between which operator()(p) lies, at most about a node's diagonal apart near the part. Cost O(1).
  Bounds bounds(Point p) const;

  /// The extended grid, and the distance at its nodes.
  const Grid& nodes() const { return nodes_; }
  double at_node(Index row, Index col) const {
    return node_distance_[static_cast<std::size_t>(nodes_.index(row, col))];
  }

 private:
  struct Bound {
    double node;  // distance at the nearest node
    double gap;   // from the point to that node
  };
  Bound bound(Point p) const;
  double distance_to_grid(Point p) const;  // to the rectangle of all pixel centres: a lower bound
  void index_rows(const HeightMap& map, const Progress& progress);
  void transform_columns(Index margin_rows, Index margin_cols, const Progress& progress);
  double squared_in_row(Index row, double x) const;
  double squared_at_column(Index row, Index col) const;  // the same at a column's x, also beyond the map

  Grid pixels_;
  Grid nodes_;
  std::vector<double> node_distance_;      // nodes_.size()
  std::vector<std::int32_t> valid_left_;   // pixels_.size(): last valid column <= this one, or -1
  std::vector<std::int32_t> valid_right_;  // pixels_.size(): first valid column >= this one, or cols
};

}  // namespace dwell
