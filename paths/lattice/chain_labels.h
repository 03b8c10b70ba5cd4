#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "paths/lattice/cell_links.h"

namespace dwell {

/// Which loop or chain of linked cells each cell belongs to, while flips join and split them (disjoint sets; a split
/// names the shorter part anew). Lone cells are chains of one.
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

  /// Before a flip or an end that joins two: makes one name of the two, unless they have it or both are open (a flip
  /// of two open chains only exchanges their tails): then false.
  bool join(Cell a, Cell b);

  /// After the loop of a cell was cut open.
  void set_open(Cell c) { chain(c).open = true; }

  /// After a flip of a square whose links belonged to one chain: finds whether that chain fell into two, and if so
  /// names the shorter part. Returns a cell of it, else -1. `steps` is lowered by the cost, about twice the shorter
  /// part.
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
