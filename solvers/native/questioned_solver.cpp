#include "solvers/native/questioned_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solvers/native/projected_lbfgs.h"

namespace dwell {

void QuestionedSolver::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  summary = solver_->solve(problem, t);
  if (summary.status != SolverStatus::Settled) return;
  SolverOptions attempt = options_;
  attempt.kind = SolverKind::ProjectedLbfgs;
  attempt.max_iterations = options_.settle_iterations;
  attempt.trace = {};
  attempt.progress.show = {};
  Vector better = t;
  const SolverSummary further = ProjectedLbfgs(attempt).solve(problem, better);
  constexpr double kRounding =
      1e-9;  // where the tolerance is zero, a solver is at rest when rounding is all that moves
  const double gain = (summary.objective - further.objective) / std::abs(summary.objective);
  if (further.status == SolverStatus::Interrupted) {
    summary.status = further.status;
    summary.message = further.message;
  } else if (gain >= std::max(options_.objective_tolerance, kRounding)) {
    summary.status = SolverStatus::Stalled;
    summary.message = fmt::format(
        "stalled after {} iterations: its objective {:.6g} no longer fell, yet {} iterations of "
        "projected-lbfgs from there lower it by {:.2g} of itself",
        summary.iterations, summary.objective, further.iterations, gain);
  }
}

}  // namespace dwell
