#pragma once

#include "core/base/progress.h"
#include "paths/domain/dice.h"
#include "paths/lattice/link_cover.h"

namespace dwell {

/// Joins the loops of each piece to one chain (a loop is cut open at last), keeping every link count of two. Chains
/// that cannot be joined remain; lone cells are left alone.
///
/// A square whose two links belong to different loops, or to a loop and a chain, joins them when it is flipped. Squares
/// are tried in random order, those beside a flipped one again. A loop that no flip joins to the rest is taken in by
/// the end of a chain beside it ("path backtracking" of Zha et al. 2020, section 3.1, towards another loop), or freed
/// by flipping random squares near it, each of which splits a loop off that is joined again elsewhere.
///
/// Cost O(cells) but for freed loops: a split costs the shorter of the two parts; all splits together are given up
/// after 30 steps a cell.
void merge_loops(CellLinks& links, const LatticePieces& pieces, Dice& dice, const Progress& progress = {});

}  // namespace dwell
