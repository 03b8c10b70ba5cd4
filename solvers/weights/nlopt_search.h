#pragma once

#include <functional>
#include <vector>

namespace dwell {

/// A function of one to a few variables in a box, each evaluation costly and slightly noisy. All vectors of variables
/// have the same size; variables should be of size one.
struct FewVariableProblem {
  std::vector<double> start, lower, upper;
  std::vector<double> first_step;  // > 0: about how far the answer may be from the start
  double tolerance = 1e-3;         // ends when steps are smaller
  int max_evaluations = 20;        // ends after these
  /// Sets the objective at x, which lies in the box; false = end the search. Called once an evaluation. It may throw:
  /// the search then ends, and the exception goes on to the caller.
  std::function<bool(const std::vector<double>& x, double& objective)> evaluate;
};

/// Minimises by NLopt's LN_COBYLA (Powell 1994, linear models in a shrinking trust region): no derivatives, any number
/// of variables from one, noise tolerated. Deterministic. Nothing is returned: `evaluate` has to
/// remember the best point, because under noise only points that were evaluated can be trusted. Throws
/// std::invalid_argument if the sizes differ.
void search_few_variables(const FewVariableProblem& problem);

}  // namespace dwell
