#include "paths/lattice/link_cover.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "core/base/poll.h"

namespace dwell {
namespace {

using Cell = CellLinks::Cell;

constexpr int kStirs = 64;  // passes over all squares

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Searches for cells over alternating paths: a link to be made, a link to be cut, and so on. Toggling such a path
/// moves a missing link from one end to the other, or closes two.
class Alternating {
 public:
  Alternating(CellLinks& links, const Progress& progress)
      : links_(links), poll_(progress), stamp_(at(links.size()), 0), by_(at(links.size()), 0) {}

  /// Searches a path from a cell that lacks a link to a cell of the other colour that lacks one, and so makes one more
  /// link. If there is none, all cells seen are retired for good: they lead nowhere now, and no later path can lead
  /// through them.
  bool augment(Cell start) {
    begin(start);
    for (std::size_t k = 0; k < queue_.size(); ++k) {
      poll_.step();
      const Cell x = queue_[k];
      for (int d = 0; d < CellLinks::kDirections; ++d) {
        const Cell y = links_.neighbour(x, d);
        if (!links_.kept(y) || links_.linked(x, d) || seen(y)) continue;
        visit(y, d);
        if (links_.degree(y) < 2) {
          toggle_back(y, start);
          return true;
        }
        follow_links(y);
      }
    }
    for (const Cell x : queue_) retire(x);
    return false;
  }

  /// Searches a path from the end of a chain to the end of a chain of the same colour, which becomes a lone cell.
  bool gather(Cell start, std::int64_t& budget) {
    begin(start);
    for (std::size_t k = 0; k < queue_.size() && budget > 0; ++k, --budget) {
      poll_.step();
      const Cell x = queue_[k];
      if (k > 0 && links_.degree(x) == 1) {
        toggle_back(x, start);
        return true;
      }
      for (int d = 0; d < CellLinks::kDirections; ++d) {
        const Cell y = links_.neighbour(x, d);
        if (!links_.kept(y) || links_.linked(x, d) || seen(y) || links_.degree(y) < 2) continue;
        visit(y, d);
        follow_links(y);
      }
    }
    return false;
  }

 private:
  static constexpr std::int32_t kRetired = -1;

  bool seen(Cell c) const { return stamp_[at(c)] == now_ || stamp_[at(c)] == kRetired; }
  void visit(Cell c, int d) {
    stamp_[at(c)] = now_;
    by_[at(c)] = static_cast<std::uint8_t>(d);
  }
  /// The neighbours of x were stamped when they were seen; they are retired with it.
  void retire(Cell x) {
    stamp_[at(x)] = kRetired;
    for (int d = 0; d < CellLinks::kDirections; ++d) {
      if (stamp_[at(links_.neighbour(x, d))] == now_) stamp_[at(links_.neighbour(x, d))] = kRetired;
    }
  }
  void begin(Cell start) {
    ++now_;
    queue_.assign(1, start);
    stamp_[at(start)] = now_;
  }
  void follow_links(Cell y) {
    for (int d = 0; d < CellLinks::kDirections; ++d) {
      const Cell z = links_.neighbour(y, d);
      if (!links_.linked(y, d) || seen(z)) continue;
      visit(z, d);
      queue_.push_back(z);
    }
  }
  void toggle_back(Cell c, Cell start) {
    while (c != start) {
      const int back = by_[at(c)] ^ 2;
      links_.toggle(c, back);
      c = links_.neighbour(c, back);
    }
  }

  CellLinks& links_;
  Poll poll_;
  std::vector<std::int32_t> stamp_;
  std::vector<std::uint8_t> by_;  // direction of the step that reached a cell
  std::vector<Cell> queue_;
  std::int32_t now_ = 0;
};

void make_blocks(CellLinks& links, RandomNumbers& dice, const Progress& progress) {
  const Cell step = links.row_step();
  const auto offset = static_cast<Cell>(dice.below(4));
  for (Cell row = links.first() + (offset >> 1) * step; row < links.end(); row += 2 * step) {
    progress.check();
    for (Cell c = row + (offset & 1); c < row + step - 2; c += 2) {
      if (!links.kept(c) || !links.kept(c + 1) || !links.kept(c + step) || !links.kept(c + step + 1)) continue;
      links.toggle(c, 0);
      links.toggle(c, 1);
      links.toggle(c + 1, 1);
      links.toggle(c + step, 0);
    }
  }
}

/// Kept cells with fewer than two links, in random order.
std::vector<Cell> open_cells(const CellLinks& links, RandomNumbers& dice, const Progress& progress) {
  Poll poll(progress);
  std::vector<Cell> open;
  for (Cell c = links.first(); c < links.end(); ++c) {
    poll.step();
    if (links.kept(c) && links.degree(c) < 2) open.push_back(c);
  }
  dice.shuffle(open, progress);
  return open;
}

/// Links the end of a chain to a random neighbour and cuts one of the neighbour's other links; the cell cut off is the
/// new end. This is the "path backtracking" of Zha et al. 2020, section 3.1 (figure 5), for a set of loops and chains.
void walk_end(CellLinks& links, Cell& end, RandomNumbers& dice) {
  const auto d = static_cast<int>(dice.bits() >> 62);
  const Cell y = links.neighbour(end, d);
  if (!links.kept(y) || links.linked(end, d) || links.degree(y) != 2 || links.degree(end) != 1) return;
  const int one = links.link_direction(y);
  const int cut = (dice.bits() >> 63) != 0 ? one : links.link_direction(y, one);
  const Cell z = links.neighbour(y, cut);
  if (links.degree(z) != 2) return;
  links.toggle(y, cut);
  links.toggle(end, d);
  end = z;
}

void augment_all(CellLinks& links, const std::vector<Cell>& open, const Progress& progress) {
  Alternating search(links, progress);
  for (const Cell c : open) {
    if (CellLinks::colour(c) != 0) continue;  // the number of links is the largest once one colour finds no more
    while (links.degree(c) < 2 && search.augment(c)) {
    }
  }
}

/// Moves the ends of the chains of each piece together until it has two.
class EndGathering {
 public:
  EndGathering(CellLinks& links, const LatticePieces& pieces, RandomNumbers& dice, const Progress& progress)
      : links_(links),
        pieces_(pieces),
        dice_(dice),
        poll_(progress, 4096),
        search_(links, progress),
        open_(open_cells(links, dice, progress)),
        ends_(pieces.pieces.size(), 0),
        budget_(50 * std::int64_t{links.size()}) {
    for (const Cell c : open_) ends_beside(c) += links.degree(c) == 1 ? 1 : 0;
  }

  void run(bool peel) {
    constexpr int kRounds = 8;
    constexpr int kPeelings = 2;
    for (int round = 0; round < kRounds; ++round) gather(false);
    for (int round = 0; peel && round < kPeelings; ++round) {
      gather(true);
      gather(false);
    }
  }

 private:
  Index& ends_beside(Cell c) { return ends_[at(pieces_.of_cell[at(c)])]; }
  /// Two ends of one colour meet in a lone cell. An end that finds no other (one on a cell without a third neighbour
  /// cannot be reached) walks to another place for the next attempt. Or it is peeled off: then its neighbour, of the
  /// other colour, is the end.
  void gather(bool peel) {
    constexpr int kSteps = 16;
    for (Cell& c : open_) {
      poll_.step();
      if (ends_beside(c) <= 2 || links_.degree(c) != 1) continue;
      if (search_.gather(c, budget_)) {
        ends_beside(c) -= 2;
      } else if (peel) {
        const int d = links_.link_direction(c);
        if (links_.degree(links_.neighbour(c, d)) != 2) continue;
        links_.toggle(c, d);
        c = links_.neighbour(c, d);
      } else {
        for (int k = 0; k < kSteps; ++k) walk_end(links_, c, dice_);
      }
    }
  }

  CellLinks& links_;
  const LatticePieces& pieces_;
  RandomNumbers& dice_;
  Poll poll_;
  Alternating search_;
  std::vector<Cell> open_;
  std::vector<Index> ends_;  // by piece
  std::int64_t budget_;
};

void stir(CellLinks& links, std::vector<Cell> ends, RandomNumbers& dice, const Progress& progress) {
  Poll poll(progress);
  for (int pass = 0; pass < kStirs; ++pass) {
    std::uint64_t bits = 0;
    int left = 0;
    for (Cell c = links.first(); c < links.end(); ++c) {
      poll.step();
      if (links.flippable(c) == 0) continue;
      if (left == 0) {
        bits = dice.bits();
        left = 64;
      }
      if ((bits & 1U) != 0) links.flip(c);
      bits >>= 1;
      --left;
    }
    for (Cell& end : ends) walk_end(links, end, dice);
  }
}

}  // namespace

Index LatticePiece::must_leave_out() const {
  Index least = std::max<Index>({std::abs(surplus()) - 1, cells > 2 ? dead_ends - 2 : 0, 0});
  if (trimmed == 0) least = std::max(least, open_ends / 2 - 1);
  return least;
}

LatticePieces find_pieces(const CellLinks& links, const Progress& progress) {
  Poll poll(progress);
  LatticePieces found{std::vector<std::int32_t>(at(links.size()), -1), {}};
  std::vector<Cell> queue;
  for (Cell c = links.first(); c < links.end(); ++c) {
    poll.step();
    if (!links.kept(c) || found.of_cell[at(c)] >= 0) continue;
    const auto name = static_cast<std::int32_t>(found.pieces.size());
    LatticePiece piece;
    queue.assign(1, c);
    found.of_cell[at(c)] = name;
    for (std::size_t k = 0; k < queue.size(); ++k) {
      poll.step();
      const Cell x = queue[k];
      ++piece.cells;
      piece.black += CellLinks::colour(x) == 0 ? 1 : 0;
      piece.dead_ends += links.kept_neighbours(x) == 1 ? 1 : 0;
      for (int d = 0; d < CellLinks::kDirections; ++d) {
        const Cell y = links.neighbour(x, d);
        if (!links.kept(y) || found.of_cell[at(y)] >= 0) continue;
        found.of_cell[at(y)] = name;
        queue.push_back(y);
      }
    }
    found.pieces.push_back(piece);
  }
  return found;
}

void trim_dead_ends(CellLinks& links, LatticePieces& pieces, RandomNumbers& dice, const Progress& progress) {
  Poll poll(progress);
  std::vector<Cell> tips;
  std::vector<std::array<Index, 2>> of_colour(pieces.pieces.size(), {0, 0});
  for (Cell c = links.first(); c < links.end(); ++c) {
    poll.step();
    if (!links.kept(c) || links.kept_neighbours(c) != 1 || pieces.of(c).dead_ends <= 2) continue;
    tips.push_back(c);
    ++of_colour[at(pieces.of_cell[at(c)])][at(CellLinks::colour(c))];
  }
  dice.shuffle(tips, progress);
  const auto in_surplus = [&](Cell c) {  // its colour has too many cells, even if all tips are left out
    const std::array<Index, 2>& tips_of = of_colour[at(pieces.of_cell[at(c)])];
    const Index surplus = pieces.of(c).surplus() - tips_of[0] + tips_of[1];
    return CellLinks::colour(c) == 0 ? surplus > 0 : surplus < 0;
  };
  std::stable_partition(tips.begin(), tips.end(), in_surplus);
  for (const Cell c : tips) {
    LatticePiece& piece = pieces.of(c);
    if (piece.dead_ends - piece.trimmed <= 2) continue;
    for (int d = 0; d < CellLinks::kDirections; ++d) {
      const Cell y = links.neighbour(c, d);
      if (!links.kept(y) || links.kept_neighbours(y) < 3) continue;
      links.drop(c);
      ++piece.trimmed;
      break;
    }
  }
}

void thin_corners(CellLinks& links, const LatticePieces& pieces, const std::vector<char>& thinned, unsigned share,
                  RandomNumbers& dice, const Progress& progress) {
  Poll poll(progress);
  for (Cell c = links.first(); c < links.end(); ++c) {
    poll.step();
    if (!links.kept(c) || links.kept_neighbours(c) != 2 || thinned[at(pieces.of_cell[at(c)])] == 0) continue;
    for (int d = 0; d < CellLinks::kDirections; ++d) {
      const Cell a = links.neighbour(c, d), b = links.neighbour(c, (d + 1) & 3);
      if (!links.kept(a) || !links.kept(b) || !links.kept(links.neighbour(a, (d + 1) & 3))) continue;
      if (links.kept_neighbours(a) > 2 && links.kept_neighbours(b) > 2 && dice.below(256) < share) links.drop(c);
      break;
    }
  }
}

void cover_with_loops(CellLinks& links, LatticePieces& pieces, bool peel, RandomNumbers& dice,
                      const Progress& progress) {
  make_blocks(links, dice, progress);
  augment_all(links, open_cells(links, dice, progress), progress);
  for (const Cell c : open_cells(links, dice, progress)) pieces.of(c).open_ends += 2 - links.degree(c);
  EndGathering(links, pieces, dice, progress).run(peel);
  std::vector<Cell> ends = open_cells(links, dice, progress);
  std::erase_if(ends, [&](Cell c) { return links.degree(c) == 0; });
  stir(links, std::move(ends), dice, progress);
}

}  // namespace dwell
