#pragma once

#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/motion/tool_path.h"
#include "paths/lattice/cell_lattice.h"

namespace dwell {

/// A curve that fills a square of side^k cells by visiting its side x side blocks one after the other, each filled by
/// the curve turned or mirrored.
struct FillingCurve {
  struct Block {
    std::uint8_t row, col, state;  // where in the square, and how it is filled
  };
  int side = 2;                            // 2 or 3
  std::vector<std::vector<Block>> states;  // for each state its blocks in order, side^2 of them; state 0 = the whole
};

/// Kept cells of a lattice in the order in which the curve over the smallest square of side^k cells that covers the
/// lattice meets them; the curve begins at cell (0, 0). A block without a kept cell is skipped after one look. Cost:
/// O(cells of the lattice) for these looks, which are cheap, and O(kept cells) for the walk.
std::vector<Index> curve_order(const CellLattice& lattice, const FillingCurve& curve, const Progress& progress = {});

/// How a curve continues where left-out cells break it.
enum class GapMove {
  Link,  // straight on if the move stays in the domain of the points and is at most kLongestLink pitches; else lifted
  Lift
};
inline constexpr double kLongestLink = 8.0;

/// The key "gaps" of the curves: link (default) or lift.
GapMove parse_gap_move(const SpecText& spec);

/// The path over a cell_lattice of the map, in the order of the curve. A step to one of the four neighbours is a move
/// of the curve; every other step is a gap. Whether a link stays in the domain is tested at every eighth of a pitch.
/// `kind` begins messages and the note that says how many gaps were linked and lifted. Cost O(pixels + points of the
/// box).
ToolPath curve_path(const HeightMap& map, const LatticeOptions& options, const FillingCurve& curve, GapMove move,
                    const char* kind, const Progress& progress = {});

}  // namespace dwell
