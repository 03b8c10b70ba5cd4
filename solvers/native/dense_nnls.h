#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Lawson and Hanson's active-set method ("Solving Least Squares Problems", 1974, ch. 23) with both bounds, on the
/// dense normal matrix. Starts with the points strictly between their bounds free. Exact to rounding; the oracle of the
/// other solvers, and quick for a few hundred points. The matrix is read off the operator column by column. Throws
/// InputError beyond kMaxPoints points or kMaxEntries matrix entries. Cost: n applications, then about n factorisations
/// of the free block, O(n^4) at worst. Memory: m n + 2 n^2.
class DenseNnls final : public DwellSolver {
 public:
  static constexpr Index kMaxPoints = 2000;
  static constexpr Index kMaxEntries = 100'000'000;

  explicit DenseNnls(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
