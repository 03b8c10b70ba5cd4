#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/random_numbers.h"
#include "paths/lattice/cell_links.h"

namespace dwell {

/// A set of cells connected by lattice edges, and how well a single path can visit it.
struct LatticePiece {
  Index cells = 0;
  Index black = 0;      // cells of colour 0
  Index dead_ends = 0;  // cells with one neighbour
  Index trimmed = 0;    // dead ends that trim_dead_ends has left out
  Index open_ends = 0;  // links that the cover lacks to two for every cell: two for each chain

  Index surplus() const { return 2 * black - cells; }  // of colour 0 over colour 1
  /// The fewest cells that any path has to leave out. A path alternates between the colours, so it has at most one cell
  /// more of one than of the other; it begins and ends once, so it has at most two dead ends; and no set of links with
  /// at most two for each cell has more links than the largest one, which leaves open_ends / 2 chains.
  Index must_leave_out() const;
};

/// The pieces of a lattice and the piece of each cell.
struct LatticePieces {
  std::vector<std::int32_t> of_cell;  // by number in CellLinks; -1 = absent
  std::vector<LatticePiece> pieces;   // in the order of their first cells

  LatticePiece& of(CellLinks::Cell c) { return pieces[static_cast<std::size_t>(of_cell[static_cast<std::size_t>(c)])]; }
};

/// Cost O(cells).
LatticePieces find_pieces(const CellLinks& links, const Progress& progress = {});

/// Leaves out dead ends beyond the two that a path can have, but only those whose neighbour has two other neighbours: a
/// path then passes beside them, and corridors one cell wide stay. Prefers the colour of which there are too many
/// cells. Counts them in the pieces.
void trim_dead_ends(CellLinks& links, LatticePieces& pieces, RandomNumbers& dice, const Progress& progress = {});

/// Leaves out cells at the convex corners of the pieces that `thinned` marks, each with the probability share / 256,
/// unless one of its two neighbours would be left with fewer than two others. On a staircase rim all such corner cells
/// have one colour. That forces every path along the rim into the same zigzag, row behind row, and leaves no way to
/// join them.
void thin_corners(CellLinks& links, const LatticePieces& pieces, const std::vector<char>& thinned, unsigned share,
                  RandomNumbers& dice, const Progress& progress = {});

/// Links as many neighbours as possible, at most two a cell, so that every piece consists of loops and as few open
/// chains as possible. Then moves the missing links together, so that wherever possible all but one of a piece's chains
/// are lone cells; with `peel`, cells are also cut off the ends of chains where that helps. Then stirs the links.
///
/// At first, whole squares of 2 x 2 cells are loops; augmenting paths link the cells between them (the largest simple
/// 2-matching of a bipartite graph). Stirring visits every square many times and flips it with probability one half if
/// it can be flipped. On a simply connected lattice this reaches all sets of loops with equal probability (the square
/// ice model), so that the directions are as even as the shape of the part allows. Cost O(cells), plus that of
/// augmenting, which searches as far as the next missing link.
void cover_with_loops(CellLinks& links, LatticePieces& pieces, bool peel, RandomNumbers& dice,
                      const Progress& progress = {});

}  // namespace dwell
