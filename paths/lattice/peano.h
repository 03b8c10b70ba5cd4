#pragma once

#include "core/base/progress.h"
#include "core/motion/tool_path.h"
#include "paths/lattice/cell_lattice.h"
#include "paths/lattice/curve_order.h"

namespace dwell {

struct PeanoOptions {
  LatticeOptions lattice;
  GapMove gaps = GapMove::Link;  // what to do where points outside the part break the curve
};

/// From "peano:pitch=MM,..."; throws InputError as SpecText does.
PeanoOptions parse_peano_options(const SpecText& spec);

/// Peano's curve over the smallest square of 3^k x 3^k points that covers the CellLattice, without the points outside
/// the part. Every point is visited once, in steps of one pitch except where left-out points break the curve (GapMove).
/// It begins at the lowest, leftmost point of the square and, undisturbed, ends at the opposite corner. Peano 1890; Tam
/// et al. 2013 compare such paths with Hilbert's in polishing.
///
/// Throws InputError as cell_lattice does. Cost O(pixels + points of the box).
ToolPath peano_path(const HeightMap& map, const PeanoOptions& options, const Progress& progress = {});

}  // namespace dwell
