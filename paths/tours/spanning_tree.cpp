#include "paths/tours/spanning_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/poll.h"
#include "paths/domain/point_limit.h"
#include "paths/domain/point_tree.h"

namespace dwell {
namespace {

constexpr auto kMaxTreePoints = static_cast<std::size_t>(kMaxPathPoints);
constexpr std::int32_t kMixed = -1;

void check(const std::vector<Point>& points) {
  if (points.empty()) throw InputError("spanning tree: no points; at least one is required");
  if (points.size() > kMaxTreePoints) {
    throw InputError(
        fmt::format("spanning tree: {}; at most {} accepted", counted(points.size(), "point"), kMaxTreePoints));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(std::isfinite(points[i].x) && std::isfinite(points[i].y))) {
      throw InputError(
          fmt::format("spanning tree: point {} is ({}, {}); required finite", i + 1, points[i].x, points[i].y));
    }
  }
}

/// Ordered by length, then by ends: no two edges are equal.
struct Edge {
  double squared = std::numeric_limits<double>::infinity();
  std::int32_t low = std::numeric_limits<std::int32_t>::max();
  std::int32_t high = std::numeric_limits<std::int32_t>::max();

  bool found() const { return high != std::numeric_limits<std::int32_t>::max(); }
  friend bool operator<(const Edge& a, const Edge& b) {
    return std::tie(a.squared, a.low, a.high) < std::tie(b.squared, b.low, b.high);
  }
};

class Boruvka {
 public:
  Boruvka(const std::vector<Point>& points, const Progress& progress)
      : points_(points),
        poll_(progress, 4096),
        tree_(points, progress),
        parent_(points.size()),
        component_(points.size()),
        nearest_(points.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  double length() {
    double sum = 0.0;
    for (std::size_t joined = 1; joined < points_.size();) {
      name_components();
      const std::vector<Edge> leaving = shortest_leaving();
      for (const Edge& edge : leaving) {
        if (!edge.found()) continue;
        const std::int32_t a = root(edge.low), b = root(edge.high);
        if (a == b) continue;  // both components chose the same edge
        parent_[at(std::max(a, b))] = std::min(a, b);
        sum += distance(points_[at(edge.low)], points_[at(edge.high)]);
        ++joined;
      }
    }
    return sum;
  }

 private:
  static std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::int32_t root(std::int32_t i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }

  /// The component of every point, and of every box of the tree that lies in one.
  void name_components() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      poll_.step();
      component_[i] = root(static_cast<std::int32_t>(i));
    }
    const std::vector<PointTree::Node>& nodes = tree_.nodes();
    box_.resize(nodes.size());
    for (std::size_t n = nodes.size(); n-- > 0;) {
      poll_.step();
      const PointTree::Node& node = nodes[n];
      if (node.child >= 0) {
        const auto child = at(node.child);
        box_[n] = box_[child] == box_[child + 1] ? box_[child] : kMixed;
        continue;
      }
      box_[n] = component_[at(tree_.members()[at(node.first)])];
      for (std::int32_t k = node.first + 1; k < node.last; ++k) {
        if (component_[at(tree_.members()[at(k)])] != box_[n]) box_[n] = kMixed;
      }
    }
  }

  /// For every component (by its root) the shortest edge that leaves it. The shortest edge of a point found in an
  /// earlier round stays its shortest while it still leaves the component, and bounds it from below afterwards.
  std::vector<Edge> shortest_leaving() {
    std::vector<Edge> best(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Edge& known = nearest_[i];
      if (known.found() && component_[at(known.low)] != component_[at(known.high)]) {
        best[at(component_[i])] = std::min(best[at(component_[i])], known);
      }
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      poll_.step();
      Edge& shortest = best[at(component_[i])];
      if (nearest_[i].found() && !(nearest_[i] < shortest)) continue;
      look_from(static_cast<std::int32_t>(i), shortest);
    }
    return best;
  }

  void look_from(std::int32_t i, Edge& shortest) {
    const std::int32_t own = component_[at(i)];
    double reach2 = shortest.squared;
    Edge mine;
    const auto take = [&](std::int32_t j) {
      if (component_[at(j)] == own) return;
      const Edge edge{squared_distance(points_[at(i)], points_[at(j)]), std::min(i, j), std::max(i, j)};
      if (!(edge < mine)) return;
      mine = edge;
      reach2 = std::min(reach2, edge.squared);
    };
    tree_.search(
        points_[at(i)], reach2, [&](std::size_t node) { return box_[node] == own; }, take);
    if (!mine.found()) return;                       // no edge is as short as the shortest so far
    if (!(shortest < mine)) nearest_[at(i)] = mine;  // a search that was cut short need not have found the shortest
    shortest = std::min(shortest, mine);
  }

  const std::vector<Point>& points_;
  Poll poll_;
  PointTree tree_;
  std::vector<std::int32_t> parent_, component_, box_;
  std::vector<Edge> nearest_;  // of every point: its shortest edge to another component when last looked for
};

}  // namespace

double spanning_tree_length(const std::vector<Point>& points, const Progress& progress) {
  check(points);
  std::vector<Point> distinct = points;  // duplicates add no length, and many of them would mean many ties
  Poll poll(progress);
  const auto less = [&poll](Point a, Point b) {
    poll.step();
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  };
  std::sort(distinct.begin(), distinct.end(), less);
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  return Boruvka(distinct, progress).length();
}

}  // namespace dwell
