#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Projected L-BFGS on the full problem (BoundedLbfgs): one operator pair an iteration. Of the matrix-free solvers that
/// make no use of the removal function's width, it takes the fewest pairs. Memory: 9 vectors of n, 3 of m.
class ProjectedLbfgs final : public DwellSolver {
 public:
  explicit ProjectedLbfgs(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
