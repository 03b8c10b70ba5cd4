#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Ceres 2.1 as bounded non-linear least squares: Levenberg-Marquardt in the trust region, steps projected onto the
/// bounds. It needs the Jacobian, so the matrix A is read off the operator column by column (n applications) and kept
/// sparse: InputError beyond kMaxPoints points or kMaxEntries non-zeros.
///
/// What is mapped, exactly: every dwell time is a parameter block with its bounds, every pixel a residual block
/// w (A t - z) - q'c, where the coefficients c of the form terms are further parameters, which is the projection P;
/// sqrt(alpha) D t and sqrt(beta) (t - t0) are residual blocks; the price gamma 1't is half the square of one residual,
/// sqrt(2 gamma 1'(t - l) + 2 f0), f0 the objective at the start, so that it stays smooth at the bounds. Entries of A
/// below 1e-12 of the largest in their column are rounding of the transform and dropped.
///
/// Ceres ends where its step, projected, comes to nothing, though the optimum may be far: the linear solve does not
/// know the bounds. So it is started again with the dwell times held that lie on a bound and are pushed outward, until
/// that changes nothing any more.
///
/// Linear solver: dense Cholesky up to kMaxDensePoints points, beyond it CGNR with the Jacobi preconditioner (inexact
/// steps). objective_tolerance is Ceres's function_tolerance (per step, which is a whole linear solve); the other rules
/// of SolverOptions are asked after every step, at the cost of one operator pair. `iterations` counts these steps.
/// Uses as many threads as OpenMP would.
class CeresSolver final : public DwellSolver {
 public:
  static constexpr Index kMaxPoints = 5000;
  static constexpr Index kMaxEntries = 8'000'000;
  static constexpr Index kMaxDensePoints = 400;

  explicit CeresSolver(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
