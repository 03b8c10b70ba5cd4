#pragma once

#include <optional>
#include <vector>

#include "core/motion/program.h"
#include "core/tif/removal_kernel.h"
#include "runs/plan/part.h"

namespace dwell {

/// The root of every pixel's share in the sums of squares, for the given linear indices: sqrt(w / mean w), so that a
/// problem with weights counts as many pixels as it has. Empty if all pixels count the same.
std::vector<double> weight_roots(const Part& part, const std::vector<Index>& pixels);

/// RMS about zero of a surface as the fit counts it [nm]: sqrt(sum w r^2 / sum w) over the counted pixels, the form
/// terms taken out by least squares of these weights. Nothing if all counted pixels have the same weight. Cost
/// O(pixels).
std::optional<double> weighted_rms(const Part& part, const HeightMap& surface);

/// The part's figure with the pixels that were measured and do not count. They take no part in the form that is
/// removed, which is carried on to them [nm].
HeightMap shown_figure(const Part& part);

/// What a program leaves, to be shown: `left` [nm], form terms removed, at the pixels that count, and at the others the
/// map less what the program removes on the lattice of `kernel`, less the form of the pixels that count. `left` itself
/// if all pixels count. Cost: two simulations.
HeightMap shown_surface(const Part& part, HeightMap left, const Program& program, const RemovalKernel& kernel);

}  // namespace dwell
