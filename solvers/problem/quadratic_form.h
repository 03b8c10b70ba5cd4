#pragma once

#include "core/removal/removal_operator.h"

namespace dwell {

/// A symmetric positive semidefinite matrix H that is known by its products.
class QuadraticForm {
 public:
  virtual ~QuadraticForm() = default;
  /// hd = H d.
  virtual void product(const Vector& d, Vector& hd) = 0;
};

}  // namespace dwell
