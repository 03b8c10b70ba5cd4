#include "solvers/fits/ceres_nonlinear_fit.h"

#include <Eigen/Core>
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "core/numerics/dense_solve.h"
#include "solvers/fits/stop_callback.h"

namespace dwell {
namespace {

/// Residuals with derivatives by central differences. Ceres' own differences have one least step, 1.5e-8, which is
/// below the rounding of sums over thousands of moves.
class DifferencedCost final : public ceres::CostFunction {
 public:
  DifferencedCost(const FitResiduals& residuals, std::size_t count, std::size_t values)
      : residuals_(residuals), values_(values) {
    set_num_residuals(static_cast<int>(count));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(values));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const std::span<const double> at(parameters[0], values_);
    const auto count = static_cast<std::size_t>(num_residuals());
    if (!residuals_(at, {residuals, count})) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    std::vector<double> moved(at.begin(), at.end()), ahead(count), behind(count);
    for (std::size_t k = 0; k < values_; ++k) {
      const double step = std::max(1e-4 * std::abs(at[k]), 1e-6);
      moved[k] = at[k] + step;
      if (!residuals_(moved, ahead)) return false;
      moved[k] = at[k] - step;
      if (!residuals_(moved, behind)) return false;
      moved[k] = at[k];
      for (std::size_t i = 0; i < count; ++i) jacobians[0][i * values_ + k] = (ahead[i] - behind[i]) / (2.0 * step);
    }
    return true;
  }

 private:
  const FitResiduals& residuals_;
  std::size_t values_;
};

void find_errors(const DifferencedCost& cost, std::size_t count, NonlinearFit& fit) {
  const std::size_t n = fit.values.size();
  std::vector<double> residuals(count), derivatives(count * n);
  const double* values = fit.values.data();
  double* jacobian = derivatives.data();
  fit.errors.assign(n, std::numeric_limits<double>::quiet_NaN());
  if (n == 0 || count <= n || !cost.Evaluate(&values, residuals.data(), &jacobian)) return;
  fit.square_sum = 0.0;
  for (const double r : residuals) fit.square_sum += r * r;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> j(derivatives.data(), static_cast<Eigen::Index>(count),
                                     static_cast<Eigen::Index>(n));
  const Eigen::MatrixXd normal = j.transpose() * j;
  Eigen::VectorXd size = normal.diagonal().cwiseSqrt();
  for (double& s : size) s = s > 0.0 ? s : 1.0;
  const Eigen::VectorXd per_size = size.cwiseInverse();
  const SymmetricEigen eigen = symmetric_eigen(per_size.asDiagonal() * normal * per_size.asDiagonal());
  const double variance = fit.square_sum / static_cast<double>(count - n);
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(n); ++k) {
    double sum = 0.0;
    for (Eigen::Index e = 0; e < static_cast<Eigen::Index>(n); ++e) {
      const double share = eigen.vectors(k, e) * eigen.vectors(k, e), value = eigen.values[e];
      if (value > 1e-10) {
        sum += share / value;
      } else if (share > 1e-6) {
        sum = std::numeric_limits<double>::quiet_NaN();
      }
    }
    fit.errors[static_cast<std::size_t>(k)] = std::sqrt(variance * sum) / size[k];
  }
}

}  // namespace

NonlinearFit fit_least_squares(const FitResiduals& residuals, std::size_t count, const std::vector<FitStart>& starts,
                               const Progress& progress) {
  NonlinearFit fit;
  for (const FitStart& start : starts) fit.values.push_back(std::clamp(start.value, start.least, start.most));
  DifferencedCost cost(residuals, count, starts.size());
  if (!starts.empty()) {
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    problem.AddResidualBlock(&cost, nullptr, fit.values.data());
    for (std::size_t k = 0; k < starts.size(); ++k) {
      if (std::isfinite(starts[k].least))
        problem.SetParameterLowerBound(fit.values.data(), static_cast<int>(k), starts[k].least);
      if (std::isfinite(starts[k].most))
        problem.SetParameterUpperBound(fit.values.data(), static_cast<int>(k), starts[k].most);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 60;
    options.function_tolerance = 1e-13;
    options.parameter_tolerance = 1e-10;
    options.gradient_tolerance = 1e-14;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    const ceres::Solver::Summary summary = solve_with_stop(options, problem, progress);
    fit.iterations = static_cast<int>(summary.iterations.size());
    fit.converged = summary.termination_type == ceres::CONVERGENCE;
  } else {
    std::vector<double> r(count);
    residuals({}, r);
    for (const double v : r) fit.square_sum += v * v;
    fit.converged = true;
  }
  find_errors(cost, count, fit);
  return fit;
}

}  // namespace dwell
