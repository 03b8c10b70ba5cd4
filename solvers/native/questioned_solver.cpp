#include "solvers/native/questioned_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "solvers/native/projected_lbfgs.h"

namespace dwell {

void QuestionedSolver::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  summary = solver_->solve(problem, t);
  if (summary.status != SolverStatus::Settled) return;
  constexpr double kLeastSeconds = 1e-9;  // a limit of no time is not one
  SolverOptions attempt = options_;
  attempt.kind = SolverKind::ProjectedLbfgs;
  attempt.max_iterations = options_.settle_iterations;
  attempt.max_seconds = std::max(kLeastSeconds, options_.max_seconds - summary.seconds);
  attempt.trace = {};
  attempt.progress.show = {};
  Vector better = t;
  const SolverSummary further = ProjectedLbfgs(attempt).solve(problem, better);
  if (further.status == SolverStatus::Interrupted || further.status == SolverStatus::TimeLimit) {
    summary.status = further.status;
    summary.message = summary.message + "; questioned: " + further.message;
    return;
  }
  constexpr double kRounding = 1e-9;  // with a tolerance of zero, a solver is at rest when only rounding moves
  const double gain = summary.objective - further.objective, size = std::abs(summary.objective);
  // NaN is no proof of rest.
  if (gain <= 0.0 || gain < std::max(options_.objective_tolerance, kRounding) * size) return;
  summary.status = SolverStatus::Stalled;
  summary.message = fmt::format(
      "stalled after {}: its objective {:.6g} no longer fell, yet {} of "
      "projected-lbfgs from there lower it by {:.2g} of itself",
      counted(summary.iterations, "iteration"), summary.objective, counted(further.iterations, "iteration"),
      gain / size);
}

}  // namespace dwell
