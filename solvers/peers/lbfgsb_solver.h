#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// L-BFGS-B 3.0, the authors' own Fortran (Zhu, Byrd, Lu, Nocedal 1997, ACM TOMS 778; Morales and Nocedal 2011),
/// which SciPy's "L-BFGS-B" is as well. Matrix-free: one operator pair an evaluation.
///
/// What is mapped: both bounds, per dwell point; every stopping rule of SolverOptions, as AdapterRun asks it (its own
/// factr and pgtol are zero). Variables and objective are scaled as for NloptSolver. kCorrections pairs are kept.
/// `iterations` counts evaluations. If its line search gives up, the status is Stalled.
/// Memory: 2 kCorrections + 5 vectors of n, and ours, 8 of n.
class LbfgsbSolver final : public DwellSolver {
 public:
  static constexpr int kCorrections = 10;

  explicit LbfgsbSolver(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
