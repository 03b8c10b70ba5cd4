#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "runs/job/job_options.h"
#include "solvers/weights/weight_search.h"

namespace dwell {

class PlanProblem;
struct WeightedDwell;

/// One evaluation of a search of the weights.
struct PlanTrial {
  Weights weights;
  TradeOff trade_off;
  double objective = 0.0;          // [nm^2], with these weights
  long operator_applications = 0;  // of its solve, and the one that measured the residual
};

/// How the weights of a plan were found.
struct PlanSearch {
  std::vector<PlanTrial> trials;  // in order
  std::size_t chosen = 0;
  std::string criterion;            // in words
  std::vector<std::string> limits;  // what was not met, a sentence each
};

/// Whether an option leaves a weight to a search. Throws InputError where both weights are to be the largest that hold
/// a residual: many pairs do, and none is the largest.
bool weights_are_searched(const JobOptions& options);

/// Chooses the weights as the options say and solves with them; each solve starts from the dwell of the nearest earlier
/// weights. The answer's dwell, status, message and objective are those of the chosen trial; its iterations, operator
/// applications, coarse work and seconds are the sums over all trials. --max-solve bounds the sum: where it ends the
/// search, the best trial so far is taken and a sentence says so. Throws as PlanProblem::solve.
/// Memory: one dwell vector a trial.
WeightedDwell search_plan(PlanProblem& problem, const JobOptions& options, const Progress& progress,
                          PlanSearch& search);

/// The text of search.csv (docs/formats.md).
std::string search_table_text(const PlanSearch& search);

}  // namespace dwell
