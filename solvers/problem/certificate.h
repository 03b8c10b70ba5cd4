#pragma once

#include "solvers/problem/dwell_problem.h"

namespace dwell {

/// Optimality of a dwell vector, from the operator alone; trusts no solver. With g the gradient of the objective at
/// t and the bounds' multipliers read off g (g+ for the lower bound, g- for the upper), the KKT conditions of the
/// convex dwell problem hold exactly where all four residuals are zero.
struct Certificate {
  double objective = 0.0;           // [nm^2]
  double residual_rms = 0.0;        // |W P (A t - z)| / sqrt(m) [nm]
  double bound_violation = 0.0;     // max(l - t, t - u, 0) [s]
  double projected_gradient = 0.0;  // |projected gradient| relative to |A' W P z|
  double dual_infeasibility = 0.0;  // largest gradient at a bound that points the wrong way, relative to |A' W P z|
  double complementarity = 0.0;  // largest |t - clip(t - g / curvature)|, curvature = |A g|^2 / |g|^2 or its like [s]

  /// Every residual finite, no bound violated, projected gradient and dual infeasibility <= tolerance.
  bool passes(double tolerance) const;
};

/// Computes the certificate. Throws std::invalid_argument for an invalid problem or t of wrong size or not finite.
/// Cost: four operator applications.
Certificate certify(const DwellProblem& problem, const Vector& t);

}  // namespace dwell
