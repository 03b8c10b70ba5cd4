#pragma once

#include <cstdint>
#include <vector>

#include "core/base/grid.h"

namespace dwell {

/// Cells of a rectangular lattice, each present or not, under a pyramid of blocks of 2 x 2, 4 x 4, ... cells that say
/// whether they hold a present cell. Finds the nearest present cell by branch and bound, exactly; a large empty area
/// costs no more than its blocks. Removing a cell costs O(log cells).
class CellPyramid {
 public:
  /// value: one number a cell, row-major, NaN = absent. Among equally near cells the highest value wins, then the
  /// lowest index.
  CellPyramid(Index rows, Index cols, std::vector<double> value);

  /// Linear index of the present cell nearest to (row, col), or -1 if none is present. Reentrant, apart from the count
  /// of blocks.
  Index nearest(Index row, Index col);
  void remove(Index cell);
  bool present(Index cell) const { return levels_[0].any[static_cast<std::size_t>(cell)] != 0; }

  /// How many blocks and cells all searches so far have looked into.
  Index blocks_searched() const { return blocks_searched_; }

 private:
  struct Level {
    Index rows = 0;
    Index cols = 0;
    std::vector<std::uint8_t> any;
  };
  struct Search {
    Index row, col;
    std::int64_t best_distance2;
    Index best;
  };

  void build_above();
  void descend(std::size_t level, Index row, Index col, Search& search);
  void consider(Index cell, std::int64_t distance2, Search& search) const;

  std::vector<double> value_;
  std::vector<Level> levels_;  // [0] = the cells, back() = one block
  Index blocks_searched_ = 0;
};

}  // namespace dwell
