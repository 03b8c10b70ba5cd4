#pragma once

#include "core/map/height_map.h"

namespace dwell {

/// Samples without data within the footprint of a removal function.
struct FootprintGaps {
  Index samples = 0;
  Index row = 0, col = 0;  // of the one beside the largest rate
  double beside = 0.0;     // that rate [nm/s]
  bool open = false;       // some are joined to the edge of the grid by others without data: no hole
};

/// Footprint: what is above `level` [nm/s]. A sample without data lies within it where it is part of a hole (no way
/// over others without data, by their sides, to the edge of the grid) that is beside the footprint, or where on three
/// of the four lines through it (row, column, both diagonals) the footprint lies on both sides: no place outside a
/// convex footprint has that on any. Cost O(samples).
FootprintGaps footprint_gaps(const HeightMap& rates, double level);

}  // namespace dwell
