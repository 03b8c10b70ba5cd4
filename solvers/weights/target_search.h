#pragma once

#include <optional>

#include "solvers/weights/weight_goal.h"
#include "solvers/weights/weight_trial.h"

namespace dwell {

/// A weight with a target.
struct TargetWeight {
  double Weights::*weight;
  WeightGoal goal;
  WeightRange range;
};

/// Looks for the weight that meets its target closely, the other weight being that of `given`: the least for a step or
/// a total, for which the range widens to its ceiling; the largest up to `most` for a residual. `tolerance` as in
/// WeightSearchOptions. The trials stand in the book. Begins at the weight `start`, or without one in the middle of the
/// range.
void search_one_target(const TargetWeight& target, const Weights& given, double tolerance, TrialBook& book,
                       std::optional<double> start = {});

/// Looks for the pair of weights that meets both targets, of which one at most is a residual, and of these for the one
/// with the least of the third quantity: with step and residual the shortest run, with total and residual the
/// smoothest, with step and total the best surface. Both ranges widen to their ceilings.
///
/// Each quantity (the residual and the step squared) is a convex function of the dwell, and the weights are the
/// multipliers of the problem "least third quantity, the others bounded". So these hold exactly, whatever the map:
/// the residual rises where both weights grow in a fixed ratio; on the line on which it equals its target, the step
/// (total) falls as the ratio turns towards smoothness (time price); at a fixed smoothness the total falls with the
/// price, and on the line on which it equals its target, the step falls with smoothness. Hence two nested searches of
/// roots of monotone functions, the inner one only as close as the outer one needs. And by duality, where the weights
/// leave the third quantity out and both targets are missed, no dwell times at all meet both: the sum that these
/// weights minimise is larger than it would be for dwell times that did.
///
/// Where no pair is found, the trials go on along the front between the targets, from where the one is met to where
/// the other is, with the weights that miss both by the same factor between. Returns whether the search came to its
/// end: a pair was found, or there is none as far as the solver's tolerance can tell.
bool search_two_targets(const TargetWeight& smoothness, const TargetWeight& price, double tolerance, TrialBook& book);

}  // namespace dwell
