#pragma once

#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Unconstrained deconvolution by a Wiener filter, sampled at the dwell points and clipped to the bounds: what many
/// workshops still do, here as a line to compare with. On the map's own pixels, with b the removal function:
///
///   T = conj(B) Z / (|B|^2 + lambda max |B|^2),  t_j = s T(p_j), clipped,
///
/// where pixels without data take the average of their neighbours under b, and where the piston is not counted the
/// target is raised until its least pixel is zero. For lambda = 1e-1, 1e-2, ... 1e-7 the scale s that fits best is
/// found and the objective evaluated; the best is kept. Strokes are taken as halts at their dwell points, spread
/// evenly.
///
/// Not an optimum, whence the status Stalled. Needs DwellPart.geometry and a problem of one part: InputError otherwise.
/// Smoothness, reference, price and weights are not seen by the filter, only by the choice. Three operator applications
/// a lambda, and three padded transforms once. Memory: four padded maps.
class FourierDeconvolution final : public DwellSolver {
 public:
  explicit FourierDeconvolution(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override;
};

}  // namespace dwell
