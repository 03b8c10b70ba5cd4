#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Projected conjugate gradients on the free face (after More and Toraldo 1991, "On the solution of large quadratic
/// programming problems with bound constraints"): a few spectral projected-gradient steps find which bounds hold,
/// conjugate gradients minimise over the rest, a projected search brings the result back into the bounds; repeated
/// until the projected gradient is small or the objective settles. Monotone: stopping at any time leaves a feasible t
/// no worse than the start. Cost of an iteration: one operator pair. Memory: 8 vectors of n, 4 of m.
class ProjectedCg final : public DwellSolver {
 public:
  explicit ProjectedCg(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
