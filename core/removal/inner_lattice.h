#pragma once

#include <vector>

#include "core/base/grid.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// The lattice on which the removal is a spline: that of the map, or one that divides its pixels.
struct InnerLattice {
  Grid grid;
  std::vector<Index> pixels;  // the nodes that are centres of the map's pixels, as given and in that order
};

/// Divides the pixels of a map. pixels: linear indices, ascending. Throws std::length_error if the lattice has more
/// than 2^31 nodes. Cost O(pixels).
InnerLattice divide_pixels(const Grid& map, const std::vector<Index>& pixels, PixelDivision division);

}  // namespace dwell
