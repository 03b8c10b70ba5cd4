#include "solvers/fits/robust_solve.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "solvers/fits/spike_removal.h"
#include "solvers/fits/stop_callback.h"

namespace dwell {

double cauchy_width(std::vector<double> residuals) {
  constexpr double kCauchy = 2.3849;
  return std::max(std::numeric_limits<double>::min(), kCauchy * robust_sigma(std::move(residuals)));
}

ceres::Problem::Options with_own_loss() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

int solve_registration(ceres::Problem& problem, int threads, const Progress& progress) {
  ceres::Solver::Options o;
  o.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  o.max_num_iterations = 50;
  o.function_tolerance = 1e-12;
  o.parameter_tolerance = 1e-12;
  o.num_threads = threads;
  o.logging_type = ceres::SILENT;
  return static_cast<int>(solve_with_stop(o, problem, progress).iterations.size());
}

}  // namespace dwell
