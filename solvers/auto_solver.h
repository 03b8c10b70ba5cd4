#pragma once

#include "solvers/dwell_solver.h"

namespace dwell {

/// The default. A removal function cannot correct what is finer than itself, so the work is done on pixels matched to
/// it and only judged on the full problem. A round: take the residual of the full problem, minimise a least-squares
/// model of it on coarser pixels within the bounds (MatchedRemoval, BoundedLbfgs), and move to the exact minimiser of
/// the full objective along the way there: one operator pair and half as much coarse work as all before.
///
/// Where dwell points lie much closer than the removal function is wide and no start is given, the first models have
/// smooth dwell on a coarse lattice as variables (SmoothDwell), on finer ones while that pays; the last has the dwell
/// points themselves. The models take their gradients as they take the removal, which keeps them least-squares
/// problems; when that is used up, on halved pixels, and then the exact gradient takes over. If a model no longer leads
/// on, its pixels are halved again; at the map's own, ProjectedLbfgs on the full problem finishes. Settled by
/// SolverOptions::objective_tolerance when a round on the dwell points gains too little, but not within the first 64
/// products.
///
/// Needs DwellProblem::geometry and a removal function wider than a few pixels; otherwise projected-lbfgs solves, and
/// the message says so. Monotone: stopping at any time leaves a feasible t no worse than the start. Memory: 14 vectors
/// of n, 3 of m and the coarse lattices.
class AutoSolver final : public DwellSolver {
 public:
  explicit AutoSolver(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
