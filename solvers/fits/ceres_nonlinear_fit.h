#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/base/progress.h"

namespace dwell {

/// A number to be fitted: where the fit starts, and what it may be.
struct FitStart {
  double value = 0.0;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

struct NonlinearFit {
  std::vector<double> values;
  std::vector<double> errors;  // standard errors; NaN where the residuals do not determine the value
  double square_sum = 0.0;     // of the residuals
  int iterations = 0;
  bool converged = false;
};

/// Writes the residuals for these values; false where they cannot be computed, and then a shorter step is tried.
using FitResiduals = std::function<bool(std::span<const double> values, std::span<double> residuals)>;

/// Minimises the sum of `count` squared residuals (Ceres: Levenberg-Marquardt, central differences, bounds). Scale the
/// values to about 1: the differences are taken over 1e-4 of a value, but of 1e-6 at least. Standard errors:
/// sigma^2 (J'J)^-1 with sigma^2 = sum of squares / (count - values), for independent errors of equal size. The start
/// must be computable. Throws Interrupted. Cost: twice as many residuals as values in each of a few dozen iterations.
NonlinearFit fit_least_squares(const FitResiduals& residuals, std::size_t count, const std::vector<FitStart>& starts,
                               const Progress& progress = {});

}  // namespace dwell
