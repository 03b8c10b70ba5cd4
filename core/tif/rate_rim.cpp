#include "core/tif/rate_rim.h"

#include <algorithm>
#include <cmath>

#include "core/numerics/median.h"

namespace dwell {
namespace {

bool at_edge(const Grid& g, Index i) {
  const Index row = i / g.cols, col = i % g.cols;
  return row == 0 || col == 0 || row == g.rows - 1 || col == g.cols - 1;
}

/// Calls `visit` with each of the four (`diagonals`: eight) neighbours.
template <typename Visit>
void each_neighbour(const Grid& g, Index i, bool diagonals, Visit&& visit) {
  const Index row = i / g.cols, col = i % g.cols;
  for (Index r = std::max<Index>(row - 1, 0); r <= std::min(row + 1, g.rows - 1); ++r) {
    for (Index c = std::max<Index>(col - 1, 0); c <= std::min(col + 1, g.cols - 1); ++c) {
      const bool itself = r == row && c == col, diagonal = r != row && c != col;
      if (!itself && (diagonals || !diagonal)) visit(g.index(r, c));
    }
  }
}

}  // namespace

std::vector<char> outside_data(const HeightMap& map) {
  const auto size = static_cast<std::size_t>(map.grid.size());
  std::vector<char> outside(size, 0);
  std::vector<Index> front;
  const auto take = [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    if (outside[k] != 0 || std::isfinite(map.values[k])) return;
    outside[k] = 1;
    front.push_back(i);
  };
  for (Index i = 0; i < map.grid.size(); ++i) {
    if (at_edge(map.grid, i)) take(i);
  }
  while (!front.empty()) {
    const Index i = front.back();
    front.pop_back();
    each_neighbour(map.grid, i, false, take);
  }
  return outside;
}

std::vector<Index> steps_from_rim(const HeightMap& map) {
  const std::vector<char> outside = outside_data(map);
  std::vector<Index> steps(outside.size(), -1);
  std::vector<Index> front, next;
  for (Index i = 0; i < map.grid.size(); ++i) {
    if (!std::isfinite(map.values[static_cast<std::size_t>(i)])) continue;
    bool rim = at_edge(map.grid, i);
    each_neighbour(map.grid, i, false, [&](Index k) { rim = rim || outside[static_cast<std::size_t>(k)] != 0; });
    if (!rim) continue;
    steps[static_cast<std::size_t>(i)] = 0;
    front.push_back(i);
  }
  for (Index step = 1; !front.empty(); ++step) {
    next.clear();
    for (const Index i : front) {
      each_neighbour(map.grid, i, true, [&](Index k) {
        const auto at = static_cast<std::size_t>(k);
        if (steps[at] >= 0 || !std::isfinite(map.values[at])) return;
        steps[at] = step;
        next.push_back(k);
      });
    }
    front.swap(next);
  }
  return steps;
}

RateRim rate_rim(const HeightMap& rates) {
  const std::vector<Index> steps = steps_from_rim(rates);
  RateRim rim;
  std::vector<double> values;
  double sum = 0.0;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    if (steps[static_cast<std::size_t>(i)] != 0) continue;
    const double v = rates.values[static_cast<std::size_t>(i)];
    if (values.empty() || v > rim.largest) rim.largest = v, rim.largest_at = rates.grid.centre(i);
    values.push_back(v);
    sum += v;
  }
  if (values.empty()) return rim;
  rim.samples = static_cast<Index>(values.size());
  rim.mean = sum / static_cast<double>(values.size());
  const double middle = upper_median(values);
  for (double& v : values) v = std::abs(v - middle);
  rim.scatter = kSigmaPerMedianDeviation * upper_median(values);
  return rim;
}

}  // namespace dwell
