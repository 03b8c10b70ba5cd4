#include "solvers/native/full_solve.h"

#include <fmt/format.h>

#include <algorithm>

#include "solvers/problem/full_hessian.h"
#include "solvers/problem/solve_limits.h"

namespace dwell {
namespace {

/// Ends a run by the options; the objective is compared at iterations a cycle apart.
class Watch {
 public:
  Watch(const DwellProblem& problem, const SolverOptions& options, SolveLimits& limits, SolverSummary& summary,
        double scale)
      : p_(problem), o_(options), limits_(limits), summary_(summary), scale_(scale) {}

  void start(double value) { checkpoint_ = value; }

  bool operator()(const QuadraticPoint& point) {
    if (!limits_.count_iteration(point.x, point.value)) return false;
    // While conjugate gradients run, the point stands still: nothing to compare until it has moved.
    if (point.value == last_value_) return true;
    last_value_ = point.value;
    // The slower the objective falls, the longer it is watched: a fixed number of iterations would stop ever earlier.
    const long watched = std::max(o_.settle_iterations, checkpoint_iteration_ / 2);
    if (summary_.iterations - checkpoint_iteration_ < watched) return true;
    if (point.value >= checkpoint_ - o_.objective_tolerance * std::abs(checkpoint_)) {
      limits_.stop(SolverStatus::Settled,
                   fmt::format("settled: objective {:.6g} fell by {:.2g} of itself in {} iterations; |pg| {:.2g}",
                               point.value, checkpoint_ > 0.0 ? (checkpoint_ - point.value) / checkpoint_ : 0.0,
                               summary_.iterations - checkpoint_iteration_,
                               projected_gradient_norm(p_.lower, p_.upper, point) / scale_));
      return false;
    }
    checkpoint_ = point.value;
    checkpoint_iteration_ = summary_.iterations;
    return true;
  }

 private:
  const DwellProblem& p_;
  const SolverOptions& o_;
  SolveLimits& limits_;
  SolverSummary& summary_;
  double scale_;
  double checkpoint_ = 0.0, last_value_ = 0.0;
  long checkpoint_iteration_ = 0;
};

/// A minimiser ends where nothing descends, and on a product that is not finite.
void end_at_rest(const DwellProblem& problem, FullHessian& hessian, const QuadraticPoint& point, double scale,
                 SolveLimits& limits, const SolverSummary& summary) {
  Vector product;
  hessian.product(point.gradient, product);
  if (product.allFinite()) {
    limits.stop(SolverStatus::Settled,
                fmt::format("settled: objective {:.6g} falls no more in rounding; |pg| {:.2g}", point.value,
                            projected_gradient_norm(problem.lower, problem.upper, point) / scale));
  } else {
    limits.stop(
        SolverStatus::Failed,
        fmt::format("failed: the operator gave a value that is not finite after {} iterations", summary.iterations));
  }
}

}  // namespace

void solve_in_full(const DwellProblem& problem, const SolverOptions& options, BoxMinimiser& minimiser, Vector& t,
                   SolverSummary& summary) {
  SolveLimits limits(problem, options, summary);
  DwellObjective objective(problem);
  FullHessian hessian(objective);
  Vector r;
  QuadraticPoint point;
  point.x = t;
  point.value = objective.evaluate(t, r, point.gradient);
  double scale = objective.gradient_scale();
  if (!(scale > 0.0)) scale = 1.0;
  Watch watch(problem, options, limits, summary, scale);
  watch.start(point.value);
  const BoxMinimiser::Monitor monitor = [&watch](const QuadraticPoint& p) { return watch(p); };
  while (!limits.converged(projected_gradient_norm(problem.lower, problem.upper, point), scale) &&
         limits.allow(point.value)) {
    const double before = point.value;
    minimiser.minimise(hessian, 0.9 * options.gradient_tolerance * scale, point, monitor);
    t = point.x;
    // The gradient carried along gathers rounding; what is reported does not.
    point.value = objective.evaluate(t, r, point.gradient);
    if (!limits.stopped() && !(point.value < before) &&
        !limits.converged(projected_gradient_norm(problem.lower, problem.upper, point), scale)) {
      end_at_rest(problem, hessian, point, scale, limits, summary);
    }
  }
  summary.objective = point.value;
}

}  // namespace dwell
