#include "solvers/native/projected_lbfgs.h"

#include "solvers/native/bounded_lbfgs.h"
#include "solvers/native/full_solve.h"

namespace dwell {

void ProjectedLbfgs::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  BoundedLbfgs lbfgs(problem.lower, problem.upper, problem.threads());
  solve_in_full(problem, options_, lbfgs, t, summary);
}

}  // namespace dwell
