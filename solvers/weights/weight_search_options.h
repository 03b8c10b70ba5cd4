#pragma once

#include "solvers/weights/weight_goal.h"

namespace dwell {

struct WeightSearchOptions {
  WeightGoal smoothness, time_price;  // at least one not Fixed
  WeightRange smoothness_range = kSmoothnessRange, time_price_range;
  /// A target is met closely enough if the quantity is below it by at most this share: the noise of the solver.
  double tolerance = 5e-3;
  int evaluations_a_weight = 20;
};

}  // namespace dwell
