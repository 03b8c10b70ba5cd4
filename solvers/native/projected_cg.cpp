#include "solvers/native/projected_cg.h"

#include "solvers/native/bounded_quadratic.h"
#include "solvers/native/full_solve.h"

namespace dwell {

void ProjectedCg::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  BoundedCg cg(problem.lower, problem.upper);
  solve_in_full(problem, options_, cg, t, summary);
}

}  // namespace dwell
