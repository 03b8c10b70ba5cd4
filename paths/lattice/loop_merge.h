#pragma once

#include "core/base/progress.h"
#include "core/base/random_numbers.h"
#include "paths/lattice/link_cover.h"

namespace dwell {

/// Joins the loops of each piece to one loop, which is cut open at the end to make a chain. Until then every cell keeps
/// its number of links. Chains that cannot be joined remain; lone cells are left alone.
///
/// A square whose two links belong to different loops, or to a loop and a chain, joins them when it is flipped. Squares
/// are tried in random order, and those beside a flipped one are tried again. A loop that no flip joins to the rest is
/// taken in by the end of a chain beside it ("path backtracking" of Zha et al. 2020, section 3.1, towards another
/// loop), or it is freed by flips of random squares near it: each splits off a loop, which is joined again elsewhere.
///
/// Cost O(cells), plus that of freeing loops: a split costs the length of the shorter part, and all splits together end
/// after 30 steps a cell.
void merge_loops(CellLinks& links, const LatticePieces& pieces, RandomNumbers& dice, const Progress& progress = {});

}  // namespace dwell
