#pragma once

#include <memory>

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// A solver whose "settled" is not taken on trust. That its own objective no longer falls may mean that it is caught
/// (NLopt's LD_LBFGS on the example mirror: 23 nm, where 4.4 nm can be had), so from its answer `settle_iterations` of
/// ProjectedLbfgs are tried. If they lower the objective by the tolerance or more, the status is Stalled. The answer
/// stays the solver's own.
/// Cost: one operator pair for each of those iterations, where the solver says that it has settled; counted.
class QuestionedSolver final : public DwellSolver {
 public:
  /// `solver` was made with the same options.
  QuestionedSolver(std::unique_ptr<DwellSolver> solver, SolverOptions options)
      : DwellSolver(std::move(options)), solver_(std::move(solver)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;

  std::unique_ptr<DwellSolver> solver_;
};

}  // namespace dwell
