#pragma once

#include <ceres/ceres.h>

#include <vector>

#include "core/base/progress.h"

namespace dwell {

/// The width of Cauchy's loss for residuals: 2.3849 robust standard deviations about zero (95 % efficiency, Holland and
/// Welsch 1977); of residuals that are all 0, where there is nothing to be robust against, the least number.
double cauchy_width(std::vector<double> residuals);

/// Options of a problem that leaves its loss function to the caller.
ceres::Problem::Options with_own_loss();

/// Solves a registration of few numbers and many residuals to the last digits. Returns the number of iterations. Throws
/// Interrupted.
int solve_registration(ceres::Problem& problem, int threads, const Progress& progress);

}  // namespace dwell
