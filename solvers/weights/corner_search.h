#pragma once

#include <cstddef>

#include "solvers/weights/weight_search_options.h"
#include "solvers/weights/weight_trial.h"

namespace dwell {

/// Chooses weights of which one at least is at its corner, the other fixed, at its corner or with a target. With x the
/// place of a weight in its range, from 0 to 1, minimises over the free weights the sum of
///
///   Corner                  log r / (change of log r) + log q / (change of log q)   over the corner range,
///   StepAtMost, TotalAtMost x,
///   ResidualAtMost          -x
///
/// subject to the target, where r is the residual RMS and q the step RMS (smoothness) or the total (time price). The
/// corner so defined is the point of the L-curve farthest from the chord between its ends, in log-log, whatever the
/// scales of the axes (Satopaa et al. 2011; the minimum of r^mu q of Reginska 1996 with the chord's slope for mu).
/// Curvature (Hansen and O'Leary 1993) would need second derivatives of what the solver leaves noisy by half a per
/// cent. Changes of less than 1 % count as 1 %: a curve without trade-off gives the end that costs nothing.
///
/// A coarse scan finds the neighbourhood of corners; NLopt does the rest. A step or a total that is missed up to the
/// end of its range is sought beyond, up to the ceiling. Returns the trial in the book that is best: of those that meet
/// the target the one of lowest sum, or, if none does, the one that misses it by the smallest factor.
std::size_t search_corners(const WeightSearchOptions& options, TrialBook& book);

}  // namespace dwell
