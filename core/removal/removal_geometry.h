#pragma once

#include <memory>
#include <vector>

#include "core/motion/tool_path.h"
#include "core/removal/removal_operator.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// What a removal operator is made of, as a value: which pixels are counted, what the tool removes, where it goes. From
/// it, a solver can build the same operator on coarser pixels.
struct RemovalGeometry {
  Grid lattice;               // the map, or what divides its pixels (core/removal/inner_lattice.h)
  std::vector<Index> pixels;  // linear indices of the valid pixels in it, ascending
  RemovalKernel kernel;       // on its pitch
  std::vector<Stroke> strokes;
  int threads = 1;
};

/// The geometry of a map's valid pixels on the lattice that the kernel asks for.
RemovalGeometry removal_geometry(const Grid& map, const std::vector<Index>& pixels, RemovalKernel kernel,
                                 std::vector<Stroke> strokes, int threads);

/// The cheapest operator: CoarseRemoval if the kernel asks for a coarse one; else, exact for the kernel's spline,
/// LatticeRemoval if the strokes are translates of one by whole pixels, or ScatteredRemoval. The operator copies what
/// it needs of the geometry.
std::unique_ptr<RemovalOperator> make_removal_operator(const RemovalGeometry& geometry);

/// The operator of several tools or passes on the same pixels: a StackedRemoval, or for one part its operator alone.
/// Throws std::invalid_argument if there is no part, or if their numbers of pixels differ.
std::unique_ptr<RemovalOperator> make_removal_operator(
    const std::vector<std::shared_ptr<const RemovalGeometry>>& geometries);

}  // namespace dwell
