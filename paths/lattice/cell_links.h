#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "paths/lattice/cell_lattice.h"

namespace dwell {

/// Links between neighbouring cells of a lattice, at most two a cell: a set of loops, open chains and lone cells.
///
/// Cells are numbered row-major with a border of absent cells around them, so that a cell always has four neighbours,
/// and with an odd stride, so that the parity of a cell's number is its colour on a chessboard, in which neighbours
/// differ. A square of 2 x 2 cells is named by its cell of lowest row and column.
class CellLinks {
 public:
  using Cell = std::int32_t;
  static constexpr int kDirections = 4;  // 0 = +col, 1 = +row, 2 = -col, 3 = -row; opposite of d: d ^ 2

  explicit CellLinks(const CellLattice& lattice);

  Cell size() const { return static_cast<Cell>(state_.size()); }
  Cell first() const { return offset_[1] + 1; }         // inside the border
  Cell end() const { return size() - offset_[1] - 1; }  // one past the last; from it up to here squares are whole
  Cell neighbour(Cell c, int d) const { return c + offset_[static_cast<std::size_t>(d)]; }
  Cell row_step() const { return offset_[1]; }
  static int colour(Cell c) { return c & 1; }

  bool kept(Cell c) const { return (state(c) & kKept) != 0; }
  void drop(Cell c) { state(c) = 0; }  // of a cell without links
  int kept_neighbours(Cell c) const {
    int count = 0;
    for (int d = 0; d < kDirections; ++d) count += kept(neighbour(c, d)) ? 1 : 0;
    return count;
  }

  bool linked(Cell c, int d) const { return ((state(c) >> d) & 1) != 0; }
  int degree(Cell c) const { return std::popcount(static_cast<unsigned>(state(c) & kLinks)); }
  /// Direction of one of the links of a cell other than `except` (-1 = none excepted); -1 if there is none.
  int link_direction(Cell c, int except = -1) const {
    const unsigned rest = state(c) & kLinks & (except < 0 ? kLinks : ~(1U << except));
    return rest == 0 ? -1 : std::countr_zero(rest);
  }
  /// Makes the link if there is none, else cuts it.
  void toggle(Cell c, int d) {
    state(c) = static_cast<std::uint8_t>(state(c) ^ (1U << d));
    std::uint8_t& other = state(neighbour(c, d));
    other = static_cast<std::uint8_t>(other ^ (1U << (d ^ 2)));
  }

  /// Whether a square has links on two opposite sides and none on the two others: 0 = no, 1 = along the rows, 2 =
  /// across.
  int flippable(Cell square) const {
    const unsigned here = state(square), right = state(square + 1), up = state(square + offset_[1]);
    const unsigned rows = (here & 1U) + (up & 1U);
    const unsigned cols = ((here >> 1) & 1U) + ((right >> 1) & 1U);
    if (rows == 2 && cols == 0) return 1;
    return rows == 0 && cols == 2 ? 2 : 0;
  }
  /// Exchanges the two linked sides of a flippable square for the two others; every cell keeps its number of links.
  void flip(Cell square) {
    const auto change = [&](Cell c, unsigned bits) { state(c) = static_cast<std::uint8_t>(state(c) ^ bits); };
    change(square, 0b0011);
    change(square + 1, 0b0110);
    change(square + offset_[1], 0b1001);
    change(square + offset_[1] + 1, 0b1100);
  }

  /// Index of a kept cell in the lattice, and back.
  Index lattice_cell(Cell c) const { return (c / offset_[1] - 1) * cols_ + c % offset_[1] - 1; }

 private:
  static constexpr unsigned kLinks = 0b01111;
  static constexpr unsigned kKept = 0b10000;

  std::uint8_t& state(Cell c) { return state_[static_cast<std::size_t>(c)]; }
  std::uint8_t state(Cell c) const { return state_[static_cast<std::size_t>(c)]; }

  Index cols_;
  std::array<Cell, 4> offset_;
  std::vector<std::uint8_t> state_;  // bits 0 to 3: linked in that direction; bit 4: kept
};

}  // namespace dwell
