#pragma once

#include <vector>

#include "core/removal_operator.h"

namespace dwell {

/// A symmetric positive semidefinite matrix H that is known by its products.
class QuadraticForm {
 public:
  virtual ~QuadraticForm() = default;
  /// hd = H d.
  virtual void product(const Vector& d, Vector& hd) = 0;
  /// out = an approximation of (H restricted to the free variables)^-1 times r, symmetric positive definite, up to a
  /// factor; r and out are zero where free is. By default r itself.
  virtual void precondition(const std::vector<char>& free, const Vector& r, Vector& out) {
    (void)free;
    out = r;
  }
};

}  // namespace dwell
