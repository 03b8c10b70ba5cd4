#pragma once

#include <cstdint>

#include "core/base/progress.h"
#include "core/motion/tool_path.h"
#include "paths/lattice/cell_lattice.h"

namespace dwell {

struct RandomOptions {
  LatticeOptions lattice;
  std::uint64_t seed = 1;  // the same seed gives the same path
};

/// From "random:pitch=MM,..."; throws InputError as SpecText does.
RandomOptions parse_random_options(const SpecText& spec);

/// What a random path leaves out and why.
struct RandomPath {
  ToolPath path;
  Index lattice_points = 0;
  Index left_out = 0;         // lattice points not visited
  Index must_leave_out = 0;   // fewest that any set of paths, one a piece, could leave out: LatticePiece
  Index left_out_beside = 0;  // how many of those left out lie one pitch from a visited point
  Index pieces = 0;           // connected sets of lattice points
  Index lifts_in_pieces = 0;  // chains beyond the first of each piece
};

/// A pseudo-random path over the points of a CellLattice. It visits every point once and moves only from neighbour to
/// neighbour along the lattice, so that it never crosses itself and never leaves the part (Zha et al. 2020, section
/// 3.1, constraints 1 to 3). There is one path for each piece of the lattice; the tool is lifted from the end of one to
/// the nearest end of the next.
///
/// The paper grows the path at its end and backs up at dead ends, which costs the length of the path each time and a
/// very long search for the last points. Here the whole lattice is covered with random loops (link_cover.h), which are
/// then merged into one (loop_merge.h); so the path has no end that could get stuck, and usually ends beside its
/// beginning. It starts at its lower end; if there are several paths, the first begins at the end nearest to the
/// lattice's lower left.
///
/// Where the lattice admits no such path, single points are left out, nearly always right beside the path. If that is
/// not enough, the piece gets several paths with lifts between (in corridors one point wide), or points at its convex
/// corners are left out too (on staircase rims), at most 64 for each lift that this saves.
///
/// Throws InputError as cell_lattice does. Cost about O(points of the box): 10^6 points in about a second, several
/// times that on ragged parts, where up to four covers are tried; memory about 60 bytes a point.
RandomPath random_path(const HeightMap& map, const RandomOptions& options, const Progress& progress = {});

}  // namespace dwell
