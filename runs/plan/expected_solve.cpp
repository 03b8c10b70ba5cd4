#include "runs/plan/expected_solve.h"

#include <fmt/format.h>

#include <algorithm>

namespace dwell {

WeightedDwell solve_expected(PlanProblem& problem, Weights weights, const Vector& known, double max_seconds,
                             std::vector<std::string>& limits, const Progress& progress) {
  constexpr int kMostSteps = 6;
  constexpr double kStep = 0.75, kLeastSeconds = 1e-9;
  const double most = problem.expected_square(known);
  WeightedDwell found;
  double seconds = 0.0;
  long iterations = 0, applications = 0;
  for (int step = 0;; ++step) {
    found = problem.solve(weights, known, std::max(max_seconds - seconds, kLeastSeconds), "solve", progress);
    seconds += found.solver.seconds, iterations += found.solver.iterations;
    applications += found.solver.operator_applications;
    found.solver.seconds = seconds, found.solver.iterations = iterations;
    found.solver.operator_applications = applications;
    if (problem.expected_square(found.dwell) <= most || seconds >= max_seconds || step == kMostSteps) break;
    weights.smoothness *= kStep, weights.time_price *= kStep;
  }
  if (problem.expected_square(found.dwell) > most)
    limits.emplace_back("the robust plan's expected residual is not below that of the plan without `robust plan`");
  return found;
}

}  // namespace dwell
