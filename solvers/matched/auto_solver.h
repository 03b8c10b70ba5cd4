#pragma once

#include "solvers/problem/dwell_solver.h"

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
/// on, its pixels are halved again; below a factor of three, ProjectedLbfgs on the full problem finishes. Settled when
/// a round on the dwell points gains less than SolverOptions::objective_tolerance of the objective, but not before 48
/// products on them; a round ends early where its model is at rest, and the first after smooth dwell with 48 products.
/// These are rules: on ten scenarios 0.1 to 1 % of the objective was left. The bound, where it is sharp (lower_bound),
/// has a say: smooth dwell proven to be within the tolerance is the answer; a settled one that may be far off goes on.
///
/// Needs DwellProblem::geometry and a removal function wider than a few pixels; otherwise projected-lbfgs solves, and
/// the message says so. Monotone: stopping at any time leaves a feasible t no worse than the start. Memory: 14 vectors
/// of n, 3 of m (4 with weights) and the coarse lattices, at most 50 / factor^2 vectors of m.
class AutoSolver final : public DwellSolver {
 public:
  explicit AutoSolver(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
