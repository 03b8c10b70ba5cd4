#pragma once

#include <cstdint>
#include <vector>

#include "core/base/grid.h"
#include "core/base/point.h"
#include "core/base/progress.h"
#include "paths/domain/path_domain.h"

namespace dwell {

inline double squared_distance(Point a, Point b) {
  const Point d = a - b;
  return d.x * d.x + d.y * d.y;
}

/// Points under a balanced tree of boxes (k-d tree, Bentley 1975), for searches by distance. Halved at the median of
/// the longer side, so that clusters and duplicates cost no more than scattered points. Memory O(n), O(n log n) to
/// build.
class PointTree {
 public:
  struct Node {
    Box box;                 // of the points beneath
    std::int32_t first = 0;  // its points are members()[first, last)
    std::int32_t last = 0;
    std::int32_t child = -1;  // its halves are child and child + 1; -1 = leaf
  };

  /// The caller makes sure that the points are finite and at most 50 million.
  explicit PointTree(const std::vector<Point>& points, const Progress& progress = {});

  /// Calls take(index) for the points in boxes whose squared distance from p is <= reach2, nearer boxes first, unless
  /// skip(node) says that nothing beneath is wanted. reach2 may shrink while the search runs; a box is opened only if
  /// it is still within reach, and then all its points are passed on untested.
  template <class Skip, class Take>
  void search(Point p, const double& reach2, Skip skip, Take take) const {
    descend(0, p, reach2, skip, take);
  }

  /// The indices of the (at most) `count` points nearest to point `index`, without itself, nearest first. Among equally
  /// near points at the end of the list, which ones are kept is arbitrary but the same on every run. Overwrites
  /// `found`.
  void nearest(std::int32_t index, std::size_t count, std::vector<std::int32_t>& found) const;

  /// Children stand behind their parent.
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<std::int32_t>& members() const { return members_; }

 private:
  void build(std::size_t node);
  Box box_of(std::int32_t first, std::int32_t last) const;

  static double squared_gap(const Box& box, Point p) {
    const double x = p.x < box.low.x ? box.low.x - p.x : p.x > box.high.x ? p.x - box.high.x : 0.0;
    const double y = p.y < box.low.y ? box.low.y - p.y : p.y > box.high.y ? p.y - box.high.y : 0.0;
    return x * x + y * y;
  }

  template <class Skip, class Take>
  void descend(std::size_t at, Point p, const double& reach2, Skip& skip, Take& take) const {
    const Node& node = nodes_[at];
    if (squared_gap(node.box, p) > reach2 || skip(at)) return;
    if (node.child < 0) {
      for (std::int32_t k = node.first; k < node.last; ++k) take(members_[static_cast<std::size_t>(k)]);
      return;
    }
    const auto low = static_cast<std::size_t>(node.child);
    const bool low_first = squared_gap(nodes_[low].box, p) <= squared_gap(nodes_[low + 1].box, p);
    descend(low_first ? low : low + 1, p, reach2, skip, take);
    descend(low_first ? low + 1 : low, p, reach2, skip, take);
  }

  const std::vector<Point> points_;
  std::vector<std::int32_t> members_;
  std::vector<Node> nodes_;
};

}  // namespace dwell
