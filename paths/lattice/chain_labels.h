#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "paths/lattice/cell_links.h"

namespace dwell {

/// Which loop or chain of linked cells each cell belongs to, while flips join and split them. (Disjoint sets; after a
/// split the shorter part gets a new name.) A lone cell is a chain of one.
class ChainLabels {
 public:
  using Cell = CellLinks::Cell;

  /// Refers to the links, which are changed by the caller. Cost O(cells).
  explicit ChainLabels(const CellLinks& links, const Progress& progress = {});

  /// Name of the chain of a kept cell, below names(); changes with every join.
  std::int32_t name(Cell c) const { return root(label_[static_cast<std::size_t>(c)]); }
  std::int32_t names() const { return static_cast<std::int32_t>(chains_.size()); }
  Index cells(Cell c) const { return chain(c).cells; }
  bool open(Cell c) const { return chain(c).open; }

  /// To be called before a flip or a new link joins the chains of two cells: gives both chains one name. False, and
  /// nothing done, if they are the same chain already or if both are open, because a flip of two open chains only
  /// exchanges their tails.
  bool join(Cell a, Cell b);

  /// To be called after the loop of a cell was cut open.
  void set_open(Cell c) { chain(c).open = true; }

  /// To be called after a flip of a square whose links belonged to one chain. If the chain fell into two, gives the
  /// shorter part a new name and returns a cell of it; else returns -1. `steps` is lowered by the cost, about twice the
  /// length of the shorter part.
  Cell split(Cell square, std::int64_t& steps);

 private:
  struct Chain {
    std::int32_t parent;
    std::int32_t cells;
    bool open;
  };

  std::int32_t root(std::int32_t name) const;
  const Chain& chain(Cell c) const { return chains_[static_cast<std::size_t>(name(c))]; }
  Chain& chain(Cell c) { return chains_[static_cast<std::size_t>(name(c))]; }
  void name_part(Cell begin, std::int32_t name);

  const CellLinks& links_;
  std::vector<std::int32_t> label_;
  mutable std::vector<Chain> chains_;  // paths to the roots are shortened while looking
};

}  // namespace dwell
