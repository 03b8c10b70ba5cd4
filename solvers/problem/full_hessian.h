#pragma once

#include "solvers/problem/dwell_problem.h"
#include "solvers/problem/quadratic_form.h"

namespace dwell {

/// The Hessian of the dwell problem itself: one operator pair a product.
class FullHessian final : public QuadraticForm {
 public:
  explicit FullHessian(DwellObjective& objective) : objective_(objective) {}
  void product(const Vector& d, Vector& hd) override {
    objective_.image(d, image_);
    objective_.hessian_times(d, image_, hd);
  }

 private:
  DwellObjective& objective_;
  Vector image_;
};

}  // namespace dwell
