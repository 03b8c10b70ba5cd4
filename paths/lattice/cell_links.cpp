#include "paths/lattice/cell_links.h"

namespace dwell {

CellLinks::CellLinks(const CellLattice& lattice) : cols_(lattice.cols), offset_{} {
  const Index stride = (lattice.cols + 2) | 1;
  const auto step = static_cast<Cell>(stride);  // a lattice has at most 50 million cells, so all numbers fit
  offset_ = {1, step, -1, -step};
  state_.resize(static_cast<std::size_t>((lattice.rows + 2) * stride));
  std::size_t cell = 0;
  for (Index row = 0; row < lattice.rows; ++row) {
    const auto begin = static_cast<std::size_t>((row + 1) * stride + 1);
    for (std::size_t col = 0; col < static_cast<std::size_t>(lattice.cols); ++col, ++cell) {
      if (lattice.kept[cell] != 0) state_[begin + col] = kKept;
    }
  }
}

}  // namespace dwell
