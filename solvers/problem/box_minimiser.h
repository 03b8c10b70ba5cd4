#pragma once

#include <functional>

#include "solvers/problem/quadratic_form.h"

namespace dwell {

/// A point of the quadratic programme: minimise q(x) = 1/2 x'Hx + c'x within l <= x <= u.
struct QuadraticPoint {
  Vector x;            // within the bounds
  Vector gradient;     // Hx + c
  double value = 0.0;  // q(x), up to a constant
};

/// |gradient restricted to what the bounds allow to move|. upper empty = no upper bounds. No workspace.
double projected_gradient_norm(const Vector& lower, const Vector& upper, const QuadraticPoint& point);

/// A method that minimises a quadratic form in a box.
class BoxMinimiser {
 public:
  /// Called as a run goes on; return false to stop. The point is feasible and no worse than the start.
  using Monitor = std::function<bool(const QuadraticPoint&)>;

  virtual ~BoxMinimiser() = default;
  /// Improves the point until |projected gradient| <= tolerance, nothing descends any more, or the monitor says stop.
  virtual void minimise(QuadraticForm& form, double tolerance, QuadraticPoint& point, const Monitor& go_on) = 0;
};

}  // namespace dwell
