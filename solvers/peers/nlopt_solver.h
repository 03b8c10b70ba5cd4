#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// NLopt's gradient-based methods with bounds (Johnson, "The NLopt nonlinear-optimization package", 2.7), each a
/// SolverKind of its own: LD_LBFGS and LD_TNEWTON_PRECOND_RESTART (Luksan), LD_MMA (Svanberg 2002), LD_SLSQP (Kraft
/// 1994). Matrix-free: objective and gradient through the operator, one operator pair an evaluation.
///
/// What is mapped: both bounds; every stopping rule of SolverOptions, as AdapterRun asks it (NLopt's own tolerances
/// are off, as it has none on the gradient). Variables are in units of the first steepest-descent step above the lower
/// bound, the objective in units of its value at the start. `iterations` counts evaluations. Where NLopt gives up by
/// itself before any rule of ours is met (rounding in a line search), the status is Stalled.
///
/// LD_SLSQP keeps dense n x n matrices and costs O(n^3) an iteration: InputError beyond kMaxSlsqpPoints.
/// Memory of the others: NLopt's own, about 10 to 25 vectors of n, and ours, 8 of n.
class NloptSolver final : public DwellSolver {
 public:
  static constexpr Index kMaxSlsqpPoints = 500;

  explicit NloptSolver(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
