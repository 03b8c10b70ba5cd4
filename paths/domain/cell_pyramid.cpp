#include "paths/domain/cell_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace dwell {
namespace {

/// Distance [cells] from i to the block `block` of 2^level cells along one axis; 0 inside.
std::int64_t gap(Index i, std::size_t level, Index block) {
  const Index first = block << level;
  const Index last = first + (Index{1} << level) - 1;
  return std::max<Index>({first - i, i - last, 0});
}

}  // namespace

CellPyramid::CellPyramid(Index rows, Index cols, std::vector<double> value) : value_(std::move(value)) {
  Level cells{rows, cols, std::vector<std::uint8_t>(value_.size())};
  std::transform(value_.begin(), value_.end(), cells.any.begin(),
                 [](double v) { return static_cast<std::uint8_t>(!std::isnan(v)); });
  levels_.push_back(std::move(cells));
  while (levels_.back().rows > 1 || levels_.back().cols > 1) build_above();
}

void CellPyramid::build_above() {
  const Level& below = levels_.back();
  Level level{(below.rows + 1) / 2, (below.cols + 1) / 2, {}};
  level.any.assign(static_cast<std::size_t>(level.rows * level.cols), 0);
  for (Index row = 0; row < below.rows; ++row) {
    for (Index col = 0; col < below.cols; ++col) {
      level.any[static_cast<std::size_t>((row / 2) * level.cols + col / 2)] |=
          below.any[static_cast<std::size_t>(row * below.cols + col)];
    }
  }
  levels_.push_back(std::move(level));
}

void CellPyramid::remove(Index cell) {
  Index row = cell / levels_[0].cols;
  Index col = cell % levels_[0].cols;
  levels_[0].any[static_cast<std::size_t>(cell)] = 0;
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    const Level& below = levels_[k - 1];
    row /= 2;
    col /= 2;
    for (Index r = 2 * row; r < std::min(2 * row + 2, below.rows); ++r) {
      for (Index c = 2 * col; c < std::min(2 * col + 2, below.cols); ++c) {
        if (below.any[static_cast<std::size_t>(r * below.cols + c)]) return;
      }
    }
    levels_[k].any[static_cast<std::size_t>(row * levels_[k].cols + col)] = 0;
  }
}

Index CellPyramid::nearest(Index row, Index col) {
  Search search{row, col, std::numeric_limits<std::int64_t>::max(), -1};
  if (levels_.back().any[0]) descend(levels_.size() - 1, 0, 0, search);
  return search.best;
}

void CellPyramid::consider(Index cell, std::int64_t distance2, Search& search) const {
  const auto better = [&] {
    if (distance2 != search.best_distance2) return distance2 < search.best_distance2;
    const double value = value_[static_cast<std::size_t>(cell)];
    const double best = value_[static_cast<std::size_t>(search.best)];
    return value != best ? value > best : cell < search.best;
  };
  if (search.best >= 0 && !better()) return;
  search.best = cell;
  search.best_distance2 = distance2;
}

void CellPyramid::descend(std::size_t level, Index row, Index col, Search& search) {
  ++blocks_searched_;
  if (level == 0) {
    const std::int64_t dr = gap(search.row, 0, row), dc = gap(search.col, 0, col);
    consider(row * levels_[0].cols + col, dr * dr + dc * dc, search);
    return;
  }
  struct Child {
    std::int64_t distance2;
    Index row, col;
  };
  std::array<Child, 4> children;
  std::size_t count = 0;
  const Level& below = levels_[level - 1];
  for (Index r = 2 * row; r < std::min(2 * row + 2, below.rows); ++r) {
    const std::int64_t dr = gap(search.row, level - 1, r);
    for (Index c = 2 * col; c < std::min(2 * col + 2, below.cols); ++c) {
      if (!below.any[static_cast<std::size_t>(r * below.cols + c)]) continue;
      const std::int64_t dc = gap(search.col, level - 1, c);
      // Insertion keeps the children nearest first: the bound then cuts off the others early.
      std::size_t at = count++;
      for (; at > 0 && children[at - 1].distance2 > dr * dr + dc * dc; --at) children[at] = children[at - 1];
      children[at] = {dr * dr + dc * dc, r, c};
    }
  }
  for (std::size_t k = 0; k < count && children[k].distance2 <= search.best_distance2; ++k) {
    descend(level - 1, children[k].row, children[k].col, search);
  }
}

}  // namespace dwell
