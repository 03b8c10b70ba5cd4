#pragma once

#include "runs/plan/dwell_options.h"
#include "runs/plan/plan_problem.h"
#include "runs/plan/weight_trials.h"

namespace dwell {

/// Chooses the weights as the options say and solves with them; each solve starts from the dwell of the nearest earlier
/// weights. The answer's dwell, status, message and objective are those of the chosen trial; its iterations, operator
/// applications, coarse work and seconds are the sums over all trials. `max_seconds`, what is left of
/// options.max_seconds, bounds the sum: where it
/// ends the search, the best trial so far is taken and a sentence in the limits says so. Throws as PlanProblem::solve.
/// Memory: one dwell vector a trial.
WeightedDwell choose_weights(PlanProblem& problem, const DwellOptions& options, double max_seconds,
                             const Progress& progress, WeightTrials& search);

}  // namespace dwell
