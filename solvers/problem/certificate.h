#pragma once

#include "solvers/problem/dwell_problem.h"

namespace dwell {

/// How near to optimal a dwell vector is, computed from the operator alone without trust in any solver. Let g be the
/// gradient of the objective at t. Its positive part gives the multipliers of the lower bounds, its negative part those
/// of the upper ones. The KKT conditions of the convex dwell problem hold exactly where the last four numbers are zero.
struct Certificate {
  double objective = 0.0;           // [nm^2]
  double residual_rms = 0.0;        // |W P (A t - z)| / sqrt(m) [nm]
  double bound_violation = 0.0;     // max(l - t, t - u, 0) [s]
  double projected_gradient = 0.0;  // |projected gradient| relative to |A' W P z|
  double dual_infeasibility = 0.0;  // largest gradient at a bound that points the wrong way, relative to |A' W P z|
  /// Largest |t - clip(t - s g)| [s]: the change of t in one steepest-descent step, cut off at the bounds. s = |p|^2 /
  /// p'Hp with p the projected gradient and H the Hessian, or 0 where there is no curvature.
  double complementarity = 0.0;
  /// Proven to be no more than the optimum's objective (lower_bound) [nm^2].
  double lower_bound = 0.0;

  /// How far the objective may be above the optimum's at most, relative to it: (objective - lower bound) / lower bound.
  /// Infinite if the bound is not above 0.
  double gap() const;

  /// Every residual finite, no bound violated, projected gradient and dual infeasibility <= tolerance.
  bool passes(double tolerance) const;
};

/// Computes the certificate. Throws std::invalid_argument for an invalid problem or t of wrong size or not finite.
/// Cost: four operator applications.
Certificate certify(const DwellProblem& problem, const Vector& t);

}  // namespace dwell
