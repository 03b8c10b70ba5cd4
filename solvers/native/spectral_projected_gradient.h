#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Spectral projected gradient (Birgin, Martinez, Raydan 2000, "Nonmonotone spectral projected gradient methods on
/// convex sets", SPG2): step along the projected gradient with the Barzilai-Borwein length; the whole step is taken if
/// the objective stays below the largest of the last ten, else the exact minimiser along it. The objective may rise
/// between iterations, never above the start; the best point seen is returned. Cost of an iteration: one operator
/// pair. Memory: 6 vectors of n, 3 of m.
class SpectralProjectedGradient final : public DwellSolver {
 public:
  explicit SpectralProjectedGradient(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
