#include "solvers/native/full_solve.h"

#include <fmt/format.h>

#include "core/base/counted.h"
#include "solvers/problem/full_hessian.h"
#include "solvers/problem/stopping_rules.h"

namespace dwell {
namespace {

/// A minimiser ends where nothing descends, and on a product that is not finite.
void end_at_rest(const DwellProblem& problem, FullHessian& hessian, const QuadraticPoint& point, StoppingRules& rules,
                 const SolverSummary& summary) {
  Vector product;
  hessian.product(point.gradient, product);
  if (product.allFinite()) {
    rules.stop_at_rest(point.value, projected_gradient_norm(problem.lower, problem.upper, point));
  } else {
    rules.stop(SolverStatus::Failed, fmt::format("failed: the operator gave a value that is not finite after {}",
                                                 counted(summary.iterations, "iteration")));
  }
}

}  // namespace

void solve_in_full(const DwellProblem& problem, const SolverOptions& options, BoxMinimiser& minimiser, Vector& t,
                   SolverSummary& summary) {
  StoppingRules rules(problem, options, summary);
  DwellObjective objective(problem);
  FullHessian hessian(objective);
  Vector r;
  QuadraticPoint point;
  point.x = t;
  point.value = objective.evaluate(t, r, point.gradient);
  rules.start(objective.gradient_scale(), point.value);
  const double tolerance = 0.9 * options.gradient_tolerance * rules.gradient_scale();
  const BoxMinimiser::Monitor monitor = [&, last_value = 0.0](const QuadraticPoint& p) mutable {
    if (!rules.count_iteration(p.x, p.value)) return false;
    // While conjugate gradients run, the point stands still; there is nothing to compare until it has moved.
    if (p.value == last_value) return true;
    last_value = p.value;
    return !rules.settled(p.value, [&] { return projected_gradient_norm(problem.lower, problem.upper, p); });
  };
  while (!rules.converged(projected_gradient_norm(problem.lower, problem.upper, point)) && rules.allow(point.value)) {
    const double before = point.value;
    minimiser.minimise(hessian, tolerance, point, monitor);
    t = point.x;
    // The updated gradient gathers rounding, so the reported one is computed anew.
    point.value = objective.evaluate(t, r, point.gradient);
    if (!rules.stopped() && !(point.value < before) &&
        !rules.converged(projected_gradient_norm(problem.lower, problem.upper, point))) {
      end_at_rest(problem, hessian, point, rules, summary);
    }
  }
  summary.objective = point.value;
}

}  // namespace dwell
