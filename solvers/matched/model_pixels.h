#pragma once

#include "core/removal/matched_kernel.h"
#include "solvers/problem/dwell_problem.h"

namespace dwell {

/// On which pixels the coarse models of a dwell problem stand. Every part's geometry must be set.

/// The coarsest pixels that hold the removal function to 1 % (matched_factor); to 3 % if noise or an edge asks for
/// pixels much finer than a Gaussian of the same energy would. Of several tools, the narrowest sets the pixels.
CoarseFactor model_pixels(const DwellProblem& problem);

/// Pitch of the finer pixels and of the lattice of smooth dwell, in sigmas: smooth dwell at 0.8 leaves 2 to 9 % of the
/// objective, at 0.4 under 1.5 %.
inline constexpr double kFinePitch = 0.5;
/// A lattice of half the pitch of `factor` or less, kFinePitch sigmas at most, even if possible, so that it can be
/// halved. sigma in pixels.
CoarseFactor fine_pixels(double sigma, CoarseFactor factor);

/// The finest factor at which a model is worth its memory. Of large maps, finer pixels are not worth their stencils:
/// 196 bytes a node, which at a factor of two is six vectors of the map. A small map has them to spare, and a removal
/// function of six of its pixels is worth no more than a factor of two.
Index finest_factor(const DwellProblem& problem);

/// Smooth dwell pays with so many dwell points a variable.
inline constexpr Index kPointsPerVariable = 3;

/// equivalent_sigma of the narrowest removal function [pixels].
double narrowest_sigma(const DwellProblem& problem);

/// Cost of an operator pair of the full problem, in the unit of transform_cost.
double pair_cost(const DwellProblem& problem);

}  // namespace dwell
