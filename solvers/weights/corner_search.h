#pragma once

#include <cstddef>

#include "solvers/weights/weight_search_options.h"
#include "solvers/weights/weight_trial.h"

namespace dwell {

/// Chooses one weight or both at their corner; a weight that is not searched is that of `given`. Minimises the sum,
/// over the weights that are,
///
///   log r / (change of log r) + log q / (change of log q)   over the corner range,
///
/// where r is the residual RMS and q the step RMS (smoothness) or the total (time price). The corner so defined is the
/// point of the L-curve farthest from the chord between its ends, in log-log, whatever the
/// scales of the axes (Satopaa et al. 2011; the minimum of r^mu q of Reginska 1996 with the chord's slope for mu).
/// Curvature (Hansen and O'Leary 1993) would need second derivatives of what the solver leaves noisy by half a per
/// cent. Changes of less than 1 % count as 1 %: a curve without trade-off gives the end that costs nothing.
///
/// A coarse scan finds the neighbourhood of corners; NLopt does the rest. Returns the best trial in the book.
std::size_t search_corners(const WeightSearchOptions& options, const Weights& given, TrialBook& book);

}  // namespace dwell
