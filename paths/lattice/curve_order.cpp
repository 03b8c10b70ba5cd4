#include "paths/lattice/curve_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/counted.h"
#include "core/base/poll.h"

namespace dwell {
namespace {

/// Kept cells, and above them whether blocks of side^2, side^4, ... cells hold one.
class BlockTree {
 public:
  BlockTree(const CellLattice& lattice, Index side, const Progress& progress) : side_(side) {
    levels_.push_back({lattice.rows, lattice.cols, {}});
    const std::vector<std::uint8_t>* below = &lattice.kept;
    kept_ = lattice.kept.data();
    while (levels_.back().rows > 1 || levels_.back().cols > 1) {
      const Level& from = levels_.back();
      Level to{(from.rows + side - 1) / side, (from.cols + side - 1) / side, {}};
      to.any.resize(static_cast<std::size_t>(to.rows * to.cols), 0);
      std::size_t cell = 0;
      for (Index row = 0; row < from.rows; ++row) {
        progress.check();
        std::uint8_t* line = to.any.data() + (row / side) * to.cols;
        for (Index col = 0, block = 0, within = 0; col < from.cols; ++col, ++cell) {
          line[block] = static_cast<std::uint8_t>(line[block] | (*below)[cell]);
          if (++within == side) {
            within = 0;
            ++block;
          }
        }
      }
      levels_.push_back(std::move(to));
      below = &levels_.back().any;
    }
  }

  std::size_t height() const { return levels_.size() - 1; }

  /// Linear index of a block, -1 if it is outside the lattice or empty.
  Index block(std::size_t level, Index row, Index col) const {
    const Level& l = levels_[level];
    if (row >= l.rows || col >= l.cols) return -1;
    const Index i = row * l.cols + col;
    return (level == 0 ? kept_[i] : l.any[static_cast<std::size_t>(i)]) != 0 ? i : -1;
  }

 private:
  struct Level {
    Index rows, cols;
    std::vector<std::uint8_t> any;  // empty for the cells themselves
  };

  Index side_;
  const std::uint8_t* kept_;
  std::vector<Level> levels_;
};

struct Walk {
  const BlockTree& tree;
  const FillingCurve& curve;
  std::vector<Index>& order;
  Poll poll;

  void fill(std::size_t level, Index row, Index col, std::size_t state) {
    const Index side = curve.side;
    for (const FillingCurve::Block& b : curve.states[state]) {
      const Index block_row = row * side + b.row, block_col = col * side + b.col;
      poll.step();
      const Index block = tree.block(level - 1, block_row, block_col);
      if (block < 0) continue;
      if (level == 1) {
        order.push_back(block);
      } else {
        fill(level - 1, block_row, block_col, b.state);
      }
    }
  }
};

/// Says how to cross a gap from one point to another.
class Gaps {
 public:
  Gaps(const HeightMap& map, CellLattice& lattice, GapMove move, const char* kind, const Progress& progress)
      : map_(map), lattice_(lattice), move_(move), kind_(kind), progress_(progress) {}

  bool link(Point from, Point to) {
    const bool stays = move_ == GapMove::Link && inside(from, to);
    ++(stays ? linked_ : lifted_);
    return stays;
  }

  void add_note(ToolPath& path) const {
    if (linked_ + lifted_ == 0) return;
    path.notes.push_back(
        fmt::format("points outside the part break the curve in {}; {} are linked by a straight move over the part, at "
                    "{} the tool is lifted",
                    counted(linked_ + lifted_, "place"), linked_, lifted_));
  }

 private:
  bool inside(Point from, Point to) {
    constexpr double kSamples = 8.0;  // a pitch
    const double pitches = distance(from, to) / lattice_.pitch;
    if (!(pitches <= kLongestLink)) return false;
    if (!lattice_.domain) lattice_.domain.emplace(map_, lattice_.reach, kind_, "overrun", progress_);
    const double count = std::ceil(kSamples * pitches);
    for (double k = 1.0; k < count; k += 1.0) {
      if (!lattice_.domain->contains(from + (k / count) * (to - from))) return false;
    }
    return true;
  }

  const HeightMap& map_;
  CellLattice& lattice_;
  GapMove move_;
  const char* kind_;
  const Progress& progress_;
  Index linked_ = 0;
  Index lifted_ = 0;
};

}  // namespace

std::vector<Index> curve_order(const CellLattice& lattice, const FillingCurve& curve, const Progress& progress) {
  std::vector<Index> order;
  order.reserve(static_cast<std::size_t>(lattice.kept_cells));
  const BlockTree tree(lattice, curve.side, progress);
  if (tree.height() == 0) {
    if (lattice.kept_cells > 0) order.push_back(0);
    return order;
  }
  Walk{tree, curve, order, Poll(progress)}.fill(tree.height(), 0, 0, 0);
  return order;
}

GapMove parse_gap_move(const SpecText& spec) {
  return spec.choice("gaps", {"link", "lift"}) == "link" ? GapMove::Link : GapMove::Lift;
}

ToolPath curve_path(const HeightMap& map, const LatticeOptions& options, const FillingCurve& curve, GapMove move,
                    const char* kind, const Progress& progress) {
  CellLattice lattice = cell_lattice(map, options, kind, progress);
  const std::vector<Index> order = curve_order(lattice, curve, progress);
  ToolPath path;
  path.kind = kind;
  path.points.resize(order.size());
  path.lifted.resize(order.size());
  Gaps gaps(map, lattice, move, kind, progress);
  Poll poll(progress);
  Index row = 0, col = 0;
  for (std::size_t j = 0; j < order.size(); ++j) {
    poll.step();
    const Index to_row = order[j] / lattice.cols, to_col = order[j] - to_row * lattice.cols;
    path.points[j] = lattice.at(to_row, to_col);
    const bool gap = std::abs(to_row - row) + std::abs(to_col - col) > 1;
    if (j == 0 || (gap && !gaps.link(path.points[j - 1], path.points[j]))) path.lifted[j] = 1;
    row = to_row;
    col = to_col;
  }
  gaps.add_note(path);
  return path;
}

}  // namespace dwell
