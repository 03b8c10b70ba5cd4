#pragma once

#include <memory>
#include <string>

#include "solvers/problem/dwell_problem.h"
#include "solvers/problem/quadratic_form.h"

namespace dwell {

/// A dwell problem in variables of a model: a surplus over the least dwell t = l + P s with s >= 0, the Hessian of the
/// objective in s, and its gradient as that Hessian takes the removal (ResolutionMatchedHessian::gradient says why).
class DwellModel {
 public:
  virtual ~DwellModel() = default;

  virtual Index size() const = 0;
  virtual QuadraticForm& form() = 0;
  /// Upper bounds on s; empty = none.
  virtual Vector largest() const = 0;
  /// d = P s.
  virtual void prolong(const Vector& s, Vector& d) const = 0;
  /// out = P'g.
  virtual void restrict_to(const Vector& g, Vector& out) = 0;
  /// Gradient of the objective in s at dwell t with residual r. May use an operator application.
  virtual void gradient(const Vector& r, const Vector& t, Vector& g) = 0;
};

/// The cheapest model that still leads to the long waves of the dwell, which say how much of it there is: smooth dwell
/// on a lattice of 0.4 sigma where the dwell points are denser than that, else the dwell points on coarse pixels, else,
/// with a removal function too narrow to coarsen or of unknown geometry, the full problem. Both must outlive it.
std::unique_ptr<DwellModel> make_dwell_model(const DwellProblem& problem, DwellObjective& objective);

}  // namespace dwell
