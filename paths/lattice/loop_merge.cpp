#include "paths/lattice/loop_merge.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/poll.h"
#include "paths/lattice/chain_labels.h"

namespace dwell {
namespace {

using Cell = CellLinks::Cell;

class Merger {
 public:
  Merger(CellLinks& links, const LatticePieces& pieces, RandomNumbers& dice, const Progress& progress)
      : progress_(progress),
        poll_(progress),
        links_(links),
        pieces_(pieces),
        dice_(dice),
        chains_(links, progress),
        budget_(30 * std::int64_t{links.size()}) {}

  void run() {
    merge_everywhere();
    take_in_lone_cells();
    take_in_everywhere();
    for (const Cell loop : loops_left()) free_loop(loop);
    bridge_loops();
    take_in_everywhere();
  }

 private:
  std::int32_t piece(Cell c) const { return pieces_.of_cell[static_cast<std::size_t>(c)]; }

  /// Flips the square if that joins two chains.
  bool merge(Cell square) {
    const int way = links_.flippable(square);
    if (way == 0) return false;
    if (!chains_.join(square, way == 1 ? square + links_.row_step() : square + 1)) return false;
    links_.flip(square);
    ++joined_;
    return true;
  }

  /// Flips the given squares, and then squares beside flipped ones, where that joins two chains. Empties the list.
  void merge_from(std::vector<Cell>& squares) {
    while (!squares.empty()) {
      poll_.step();
      const Cell square = squares.back();
      squares.pop_back();
      if (!merge(square)) continue;
      for (int d = 0; d < CellLinks::kDirections; ++d) squares.push_back(links_.neighbour(square, d));
    }
  }

  void merge_everywhere() {
    std::vector<Cell> order;
    for (Cell c = links_.first(); c < links_.end(); ++c) {
      poll_.step();
      if (links_.kept(c)) order.push_back(c);
    }
    dice_.shuffle(order, progress_);
    for (const Cell square : order) {
      squares_.assign(1, square);
      merge_from(squares_);
    }
  }

  /// Joins the end of a chain to a loop beside it, which opens there, and goes on from the new end.
  void take_in(Cell end) {
    for (bool again = true; again && links_.degree(end) < 2;) {
      again = false;
      const auto turn = static_cast<int>(dice_.below(CellLinks::kDirections));
      for (int k = 0; k < CellLinks::kDirections && !again; ++k) {
        const int d = (turn + k) & 3;
        const Cell y = links_.neighbour(end, d);
        if (!links_.kept(y) || links_.degree(y) != 2 || chains_.open(y) || !chains_.join(end, y)) continue;
        const int one = links_.link_direction(y);
        const int cut = (dice_.bits() >> 63) != 0 ? one : links_.link_direction(y, one);
        links_.toggle(y, cut);
        links_.toggle(end, d);
        ++joined_;
        near(end, 1);
        end = links_.neighbour(y, cut);
        near(end, 1);
        merge_from(squares_);
        again = true;
      }
    }
  }

  /// Where a piece has no chain but lone cells, one of these joins a loop, which opens there.
  void take_in_lone_cells() {
    std::vector<char> has_chain = pieces_with_ends();
    for (Cell c = links_.first(); c < links_.end(); ++c) {
      poll_.step();
      if (!links_.kept(c) || links_.degree(c) != 0 || has_chain[static_cast<std::size_t>(piece(c))] != 0) continue;
      take_in(c);
      has_chain[static_cast<std::size_t>(piece(c))] = links_.degree(c) > 0 ? 1 : 0;
    }
  }

  std::vector<char> pieces_with_ends() const {
    std::vector<char> has_end(pieces_.pieces.size(), 0);
    for (Cell c = links_.first(); c < links_.end(); ++c) {
      poll_.step();
      if (links_.degree(c) == 1) has_end[static_cast<std::size_t>(piece(c))] = 1;
    }
    return has_end;
  }

  void take_in_everywhere() {
    for (Cell c = links_.first(); c < links_.end(); ++c) {
      poll_.step();
      if (links_.degree(c) == 1) take_in(c);
    }
  }

  /// Where a piece has nothing but loops and two of them stand side by side: both open there and become a chain.
  void bridge_loops() {
    std::vector<char> has_chain = pieces_with_ends();
    for (Cell c = links_.first(); c < links_.end(); ++c) {
      poll_.step();
      if (links_.degree(c) != 2 || has_chain[static_cast<std::size_t>(piece(c))] != 0) continue;
      for (int d = 0; d < 2; ++d) {
        const Cell y = links_.neighbour(c, d);
        if (links_.degree(y) != 2 || !chains_.join(c, y)) continue;
        links_.toggle(c, links_.link_direction(c));
        links_.toggle(y, links_.link_direction(y));
        links_.toggle(c, d);
        chains_.set_open(c);
        ++joined_;
        has_chain[static_cast<std::size_t>(piece(c))] = 1;
        break;
      }
    }
  }

  /// Adds the squares within a distance of one, in random order.
  void near(Cell square, int reach) {
    const std::size_t before = squares_.size();
    for (int row = -reach; row <= reach; ++row) {
      for (int col = -reach; col <= reach; ++col) {
        const Cell c = square + row * links_.row_step() + col;
        if (c >= links_.first() && c < links_.end()) squares_.push_back(c);
      }
    }
    std::vector<Cell> shuffled(squares_.begin() + static_cast<std::ptrdiff_t>(before), squares_.end());
    dice_.shuffle(shuffled);
    std::copy(shuffled.begin(), shuffled.end(), squares_.begin() + static_cast<std::ptrdiff_t>(before));
  }

  /// A cell of each loop but the longest loop or chain of each piece.
  std::vector<Cell> loops_left() const {
    std::vector<Cell> head(static_cast<std::size_t>(chains_.names()), -1);
    std::vector<Cell> heads;
    std::vector<Cell> longest(pieces_.pieces.size(), -1);
    for (Cell c = links_.first(); c < links_.end(); ++c) {
      poll_.step();
      if (links_.degree(c) == 0) continue;
      Cell& first = head[static_cast<std::size_t>(chains_.name(c))];
      if (first >= 0) continue;
      first = c;
      heads.push_back(c);
      Cell& best = longest[static_cast<std::size_t>(piece(c))];
      if (best < 0 || chains_.cells(c) > chains_.cells(best)) best = c;
    }
    std::erase_if(heads, [&](Cell c) { return longest[static_cast<std::size_t>(piece(c))] == c || chains_.open(c); });
    return heads;
  }

  /// A cell some links farther along the chain of a cell.
  Cell along(Cell c) {
    constexpr std::uint32_t kFarthest = 1024;
    std::uint32_t steps = dice_.below(kFarthest);
    int way = links_.link_direction(c);
    for (; steps > 0 && way >= 0; --steps, --budget_) {
      c = links_.neighbour(c, way);
      way = links_.link_direction(c, way ^ 2);
    }
    return c;
  }

  /// Splits and joins near the loop of a cell until there is one loop fewer.
  void free_loop(Cell loop) {
    constexpr int kTries = 4000;
    // Tries between two questions whether to stop: a split walks through up to half of a chain.
    constexpr int kAskEvery = 64;
    constexpr int kNear = 2;  // cells from the loop
    const Index before = joined_;
    for (int k = 0; k < kTries && budget_ > 0; ++k) {
      if (k % kAskEvery == 0) progress_.check();
      loop = along(loop);
      const Cell square = loop + (static_cast<Cell>(dice_.below(2 * kNear + 1)) - kNear) * links_.row_step() +
                          static_cast<Cell>(dice_.below(2 * kNear + 1)) - kNear;
      if (square < links_.first() || square >= links_.end() || links_.flippable(square) == 0) continue;
      const Cell other = links_.flippable(square) == 1 ? square + links_.row_step() : square + 1;
      if (chains_.name(square) != chains_.name(other)) continue;
      links_.flip(square);
      const Cell part = chains_.split(square, budget_);
      joined_ -= part >= 0 ? 1 : 0;
      squares_.clear();
      near(square, kNear + 1);
      std::erase(squares_, square);
      merge_from(squares_);
      squares_.assign(1, square);
      merge_from(squares_);
      if (joined_ > before) return;
      if (part >= 0 && chains_.cells(part) < chains_.cells(loop)) loop = part;
    }
  }

  const Progress& progress_;
  mutable Poll poll_;
  CellLinks& links_;
  const LatticePieces& pieces_;
  RandomNumbers& dice_;
  ChainLabels chains_;
  std::int64_t budget_;
  Index joined_ = 0;           // how many chains there are fewer than at the beginning
  std::vector<Cell> squares_;  // work list of merge_from
};

}  // namespace

void merge_loops(CellLinks& links, const LatticePieces& pieces, RandomNumbers& dice, const Progress& progress) {
  Merger(links, pieces, dice, progress).run();
}

}  // namespace dwell
