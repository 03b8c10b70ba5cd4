#include "paths/domain/point_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/numbers.h"

namespace dwell {
namespace {

constexpr std::int32_t kLeaf = 8;
constexpr std::int32_t kAskedAbove = 4096;  // points of a box: for smaller ones a question takes longer than the work

}  // namespace

PointTree::PointTree(const std::vector<Point>& points, const Progress& progress)
    : points_(points), members_(points.size()) {
  std::iota(members_.begin(), members_.end(), 0);
  const auto count = static_cast<std::int32_t>(points.size());
  if (count == 0) {
    nodes_.push_back({Box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}}, 0, 0, -1});
    return;
  }
  nodes_.push_back({box_of(0, count), 0, count, -1});
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    if (nodes_[node].last - nodes_[node].first > kAskedAbove) progress.check();
    build(node);
  }
}

Box PointTree::box_of(std::int32_t first, std::int32_t last) const {
  Box box{points_[static_cast<std::size_t>(members_[static_cast<std::size_t>(first)])], {}};
  box.high = box.low;
  for (std::int32_t k = first + 1; k < last; ++k) {
    const Point p = points_[static_cast<std::size_t>(members_[static_cast<std::size_t>(k)])];
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

void PointTree::build(std::size_t at) {
  const Node node = nodes_[at];
  if (node.last - node.first <= kLeaf) return;
  const bool by_x = node.box.high.x - node.box.low.x >= node.box.high.y - node.box.low.y;
  const std::int32_t middle = node.first + (node.last - node.first) / 2;
  const auto along = [&](std::int32_t i) {
    const Point p = points_[static_cast<std::size_t>(i)];
    return std::pair(by_x ? p.x : p.y, i);
  };
  std::nth_element(members_.begin() + node.first, members_.begin() + middle, members_.begin() + node.last,
                   [&](std::int32_t a, std::int32_t b) { return along(a) < along(b); });
  nodes_[at].child = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({box_of(node.first, middle), node.first, middle, -1});
  nodes_.push_back({box_of(middle, node.last), middle, node.last, -1});
}

void PointTree::nearest(std::int32_t index, std::size_t count, std::vector<std::int32_t>& found) const {
  const Point p = points_[static_cast<std::size_t>(index)];
  double reach2 = kInfinity;
  const auto key = [&](std::int32_t i) {
    return std::pair(squared_distance(p, points_[static_cast<std::size_t>(i)]), i);
  };
  found.clear();
  if (count == 0) return;
  const auto take = [&](std::int32_t i) {
    if (i == index || (found.size() == count && !(key(i) < key(found.back())))) return;
    if (found.size() == count) found.pop_back();
    const auto before = [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); };
    found.insert(std::upper_bound(found.begin(), found.end(), i, before), i);
    // Points at the same distance are not searched for; otherwise each of many duplicates would search through all of
    // them.
    if (found.size() == count) reach2 = std::nextafter(key(found.back()).first, -kInfinity);
  };
  search(
      p, reach2, [](std::size_t) { return false; }, take);
}

}  // namespace dwell
