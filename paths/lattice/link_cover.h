#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "paths/domain/dice.h"
#include "paths/lattice/cell_links.h"

namespace dwell {

/// A set of cells connected by lattice edges, and how well a single path can visit it.
struct LatticePiece {
  Index cells = 0;
  Index black = 0;      // cells of colour 0
  Index dead_ends = 0;  // cells with one neighbour
  Index trimmed = 0;    // of the dead ends, left out before all else
  Index open_ends = 0;  // links missing to two a cell, after the cover; two a chain

  Index surplus() const { return 2 * black - cells; }  // of colour 0 over colour 1
  /// Fewest cells that any path has to leave out: it alternates between the colours, so has at most one cell more of
  /// one than of the other; it begins and ends once, so has at most two dead ends; and as a set of links of at most
  /// two a cell it has no more of them than the largest such set, which leaves open_ends / 2 chains.
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

/// Leaves out dead ends beyond the two that a path can have, as far as they stand on a cell that has two other
/// neighbours, so that a path passes beside them (corridors one cell wide are not eaten up). Chooses them by the colour
/// of which there are too many. Counts them in the pieces.
void trim_dead_ends(CellLinks& links, LatticePieces& pieces, Dice& dice, const Progress& progress = {});

/// Leaves out a share of the cells at convex corners of some pieces (by piece: 0 = none of its cells), in numbers of 1
/// / 256 and at random, as far as both neighbours keep two others. A staircase rim has its cells at such corners all of
/// one colour, which forces every path along it into the same zigzag, rank behind rank, and leaves no way to join them.
void thin_corners(CellLinks& links, const LatticePieces& pieces, const std::vector<char>& thinned, unsigned share,
                  Dice& dice, const Progress& progress = {});

/// Links as many neighbours as possible, at most two a cell, so that every piece falls into loops and as few open
/// chains as can be; then moves the missing links together, so that of the chains of a piece all but one are lone
/// cells wherever that is possible; `peel` also cuts cells off the ends of chains where that helps. Then stirs the
/// links.
///
/// Squares of 2 x 2 cells are loops; the cells between are joined by augmenting paths (the largest simple 2-matching of
/// a bipartite graph). Stirring visits every square many times and flips it at even odds if it can be flipped, which
/// leads to all sets of loops over a simply connected lattice with equal probability (the square ice model); the
/// directions are then as even as the shape of the part allows. Cost O(cells) but for augmenting, which searches as
/// far as the next missing link.
void cover_with_loops(CellLinks& links, LatticePieces& pieces, bool peel, Dice& dice, const Progress& progress = {});

}  // namespace dwell
