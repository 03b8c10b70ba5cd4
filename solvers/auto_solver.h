#pragma once

#include "solvers/dwell_solver.h"

namespace dwell {

/// The default. A removal function cannot correct what is finer than itself, so the work is done on pixels matched to
/// it and only judged on the full problem (iterative refinement). Repeatedly: take the gradient on the full problem
/// (one operator pair), minimise the quadratic model that has this gradient and the Hessian of coarser pixels within
/// the bounds, and move to the exact minimiser of the full objective along the way there. The Hessians are accurate to
/// a few percent (solvers/resolution_matched_hessian.h), so that most steps are taken whole.
///
/// Where dwell points lie much closer than the removal function is wide and no start is given, the first models have
/// smooth dwell on a coarse lattice as variables, twice finer each time; the last has the dwell points themselves. If a
/// model no longer leads on, its pixels are halved; at the map's own, projected conjugate gradients on the full problem
/// finish. Every model of the dwell points is given as much work as all before it; SolverOptions::gap_tolerance says
/// when to stop.
///
/// Needs DwellProblem::geometry and a removal function wider than a few pixels; otherwise projected-cg solves, and the
/// message says so. Monotone: stopping at any time leaves a feasible t no worse than the start. Memory: 11 vectors of
/// n, 4 of m and the models.
class AutoSolver final : public DwellSolver {
 public:
  explicit AutoSolver(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
