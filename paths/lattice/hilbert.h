#pragma once

#include "core/base/progress.h"
#include "core/motion/tool_path.h"
#include "paths/lattice/cell_lattice.h"
#include "paths/lattice/curve_order.h"

namespace dwell {

struct HilbertOptions {
  LatticeOptions lattice;
  GapMove gaps = GapMove::Link;  // what to do where points outside the part break the curve
};

/// From "hilbert:pitch=MM,..."; throws InputError as SpecText does.
HilbertOptions parse_hilbert_options(const SpecText& spec);

/// Hilbert's curve over the smallest square of 2^k x 2^k points that covers the CellLattice, without the points outside
/// the part. Every point is visited once, in steps of one pitch except where left-out points break the curve (GapMove).
/// It begins at the lowest, leftmost point of the square and, undisturbed, ends at the lowest, rightmost. Lin et al.
/// 2014, section 2.3, for its use in polishing; Hilbert 1891.
///
/// Throws InputError as cell_lattice does. Cost O(pixels + points of the box).
ToolPath hilbert_path(const HeightMap& map, const HilbertOptions& options, const Progress& progress = {});

}  // namespace dwell
