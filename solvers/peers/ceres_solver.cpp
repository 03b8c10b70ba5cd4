#include "solvers/peers/ceres_solver.h"

#include <Eigen/SparseCore>
#include <ceres/ceres.h>
#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "solvers/peers/adapter_run.h"

namespace dwell {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, Index>;

Matrix read_off(RemovalOperator& removal) {
  constexpr double kRounding = 1e-12;  // of the largest entry of a column
  std::vector<Eigen::Triplet<double, Index>> entries;
  Vector unit = Vector::Zero(removal.cols()), column;
  for (Index j = 0; j < removal.cols(); ++j) {
    unit[j] = 1.0;
    removal.apply(unit, column);
    unit[j] = 0.0;
    const double floor = kRounding * column.cwiseAbs().maxCoeff();
    for (Index i = 0; i < column.size(); ++i) {
      if (std::abs(column[i]) > floor) entries.emplace_back(i, j, column[i]);
    }
    if (static_cast<Index>(entries.size()) > CeresSolver::kMaxEntries) {
      throw InputError(
          fmt::format("solver = 'ceres' with more than {} non-zeros in the removal matrix (in {} of {} of "
                      "its columns); it needs the whole matrix: choose another solver",
                      CeresSolver::kMaxEntries, j + 1, removal.cols()));
    }
  }
  Matrix a(removal.rows(), removal.cols());
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

/// A residual linear in some of the parameter blocks, all of size one but perhaps the last:
/// r = sum_k a_k x_k + last' y - constant.
class LinearResidual final : public ceres::CostFunction {
 public:
  LinearResidual(std::vector<double> coefficients, Eigen::VectorXd last, double constant)
      : coefficients_(std::move(coefficients)), last_(std::move(last)), constant_(constant) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(coefficients_.size(), 1);
    if (last_.size() != 0) mutable_parameter_block_sizes()->push_back(static_cast<int>(last_.size()));
  }

  bool Evaluate(const double* const* x, double* residual, double** jacobians) const override {
    const std::size_t n = coefficients_.size();
    double sum = -constant_;
    for (std::size_t k = 0; k < n; ++k) sum += coefficients_[k] * x[k][0];
    for (Index i = 0; i < last_.size(); ++i) sum += last_[i] * x[n][i];
    residual[0] = sum;
    if (!jacobians) return true;
    for (std::size_t k = 0; k < n; ++k) {
      if (jacobians[k]) jacobians[k][0] = coefficients_[k];
    }
    if (last_.size() != 0 && jacobians[n]) Eigen::Map<Eigen::VectorXd>(jacobians[n], last_.size()) = last_;
    return true;
  }

 private:
  std::vector<double> coefficients_;
  Eigen::VectorXd last_;
  double constant_;
};

/// Half its square is gamma p'(t - l) + offset, p the prices of the points.
class PriceResidual final : public ceres::CostFunction {
 public:
  PriceResidual(const DwellProblem& problem, double offset)
      : prices_(Vector::Zero(problem.points())),
        least_(priced_total(problem, problem.lower)),
        gamma_(problem.gamma),
        offset_(offset) {
    add_prices(problem, 1.0, prices_);
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(problem.points()), 1);
  }

  bool Evaluate(const double* const* t, double* residual, double** jacobians) const override {
    const std::size_t n = parameter_block_sizes().size();
    double total = 0.0;
    for (std::size_t j = 0; j < n; ++j) total += prices_[static_cast<Index>(j)] * t[j][0];
    const double square = 2.0 * (gamma_ * (total - least_) + offset_);
    if (!(square > 0.0)) return false;
    residual[0] = std::sqrt(square);
    if (!jacobians) return true;
    for (std::size_t j = 0; j < n; ++j) {
      if (jacobians[j]) jacobians[j][0] = gamma_ * prices_[static_cast<Index>(j)] / residual[0];
    }
    return true;
  }

 private:
  Vector prices_;
  double least_, gamma_, offset_;
};

/// The dwell problem as Ceres has it, and the parameters that it changes.
class Model {
 public:
  Model(const DwellProblem& problem, const Vector& start) : p_(problem), t_(start) {
    const Matrix a = read_off(*p_.removal);
    if (p_.form.cols() != 0) {
      const Vector left = a * t_ - p_.target;
      const Index rows = left.size() / p_.blocks();
      for (Index block = 0; block < p_.blocks(); ++block) {
        Vector fit = left.segment(block * rows, rows);
        if (p_.weights.size() != 0) fit.array() *= p_.weights.array();
        forms_.emplace_back(p_.form.transpose() * fit);
      }
    }
    for (Index j = 0; j < t_.size(); ++j) {
      ceres_.AddParameterBlock(&t_[j], 1);
      ceres_.SetParameterLowerBound(&t_[j], 0, p_.lower[j]);
      if (std::isfinite(p_.upper_at(j))) ceres_.SetParameterUpperBound(&t_[j], 0, p_.upper_at(j));
    }
    add_pixels(a);
    add_weights_on_dwell();
    if (p_.gamma > 0.0) add_price();
  }

  ceres::Problem& problem() { return ceres_; }

  /// Holds the dwell times that are on a bound and that the gradient pushes outward, frees the others. Returns whether
  /// that changed any.
  bool hold(const Vector& gradient) {
    bool changed = false;
    for (Index j = 0; j < t_.size(); ++j) {
      const double l = p_.lower[j], u = p_.upper_at(j);
      // Ceres wants room between the bounds of what it varies.
      const bool held = !(l < u) || (t_[j] <= l && gradient[j] > 0.0) || (t_[j] >= u && gradient[j] < 0.0);
      if (held == ceres_.IsParameterBlockConstant(&t_[j])) continue;
      changed = true;
      if (held) {
        ceres_.SetParameterBlockConstant(&t_[j]);
      } else {
        ceres_.SetParameterBlockVariable(&t_[j]);
      }
    }
    return changed;
  }
  const Vector& dwell() const { return t_; }

 private:
  void add_pixels(const Matrix& a) {
    const Index rows = a.rows() / p_.blocks();
    for (Index i = 0; i < a.rows(); ++i) {
      const double w = p_.weights.size() == 0 ? 1.0 : p_.weights[i % rows];
      std::vector<double> coefficients;
      std::vector<double*> blocks;
      for (Matrix::InnerIterator entry(a, i); entry; ++entry) {
        coefficients.push_back(w * entry.value());
        blocks.push_back(&t_[entry.col()]);
      }
      Eigen::VectorXd form;
      if (!forms_.empty()) {
        form = -p_.form.row(i % rows).transpose();
        blocks.push_back(forms_[static_cast<std::size_t>(i / rows)].data());
      }
      if (blocks.empty()) continue;  // a pixel that nothing reaches adds a constant
      ceres_.AddResidualBlock(new LinearResidual(std::move(coefficients), std::move(form), w * p_.target[i]), nullptr,
                              blocks);
    }
  }

  void add_weights_on_dwell() {
    const Index n = t_.size();
    for_parts(p_, [&](const DwellPart& part, Index first, Index points) {
      const PathSmoothness& d = part.smoothness;
      const double root = std::sqrt(p_.alpha_of(part));
      for (Index j = 1; root > 0.0 && !d.empty() && j < points; ++j) {
        if (!d.linked(j)) continue;
        const double before = root * d.scale(j - 1), here = root * d.scale(j);
        const double of_least = here * p_.lower[first + j] - before * p_.lower[first + j - 1];
        ceres_.AddResidualBlock(new LinearResidual({-before, here}, {}, of_least), nullptr,
                                std::vector<double*>{&t_[first + j - 1], &t_[first + j]});
      }
    });
    for (Index j = 0; p_.beta > 0.0 && j < n; ++j) {
      const double root = std::sqrt(p_.beta), t0 = p_.reference.size() == 0 ? 0.0 : p_.reference[j];
      ceres_.AddResidualBlock(new LinearResidual({root}, {}, root * t0), nullptr, &t_[j]);
    }
  }

  void add_price() {
    DwellObjective objective(p_);
    Vector r;
    objective.residual(t_, r);
    const double start = objective.value(r, t_);
    std::vector<double*> blocks;
    for (double& t : t_) blocks.push_back(&t);
    ceres_.AddResidualBlock(new PriceResidual(p_, start > 0.0 ? start : 1.0), nullptr, blocks);
  }

  const DwellProblem& p_;
  Vector t_;
  std::vector<Eigen::VectorXd> forms_;  // of each block of rows
  ceres::Problem ceres_;
};

/// Shows every iterate to the run, which asks our rules.
class Observer final : public ceres::IterationCallback {
 public:
  Observer(AdapterRun& run, const Model& model) : run_(run), model_(model) {}

  /// Evaluates the model's present dwell; returns the gradient there.
  const Vector& evaluate() {
    t_ = model_.dwell();
    run_.evaluate(t_, gradient_);
    return gradient_;
  }
  const Vector& gradient() const { return gradient_; }

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    // A start has been evaluated already, and a step that was not taken leaves the dwell as it was.
    if (iteration.iteration > 0 && iteration.step_is_successful) evaluate();
    return run_.stopped() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  AdapterRun& run_;
  const Model& model_;
  Vector t_, gradient_;
};

ceres::Solver::Options options_for(const SolverOptions& options, Index points) {
  ceres::Solver::Options o;
  o.minimizer_type = ceres::TRUST_REGION;
  o.linear_solver_type = points <= CeresSolver::kMaxDensePoints ? ceres::DENSE_NORMAL_CHOLESKY : ceres::CGNR;
  o.preconditioner_type = ceres::JACOBI;
  o.max_linear_solver_iterations = 100;  // Ceres looks at the clock between linear solves only
  o.max_num_iterations = static_cast<int>(std::min<long>(options.max_iterations, 1'000'000));
  o.max_solver_time_in_seconds = options.max_seconds;
  o.function_tolerance = options.objective_tolerance;
  o.gradient_tolerance = 0.0;
  o.parameter_tolerance = 0.0;
  o.num_threads = omp_get_max_threads();
  o.logging_type = ceres::SILENT;
  o.update_state_every_iteration = true;
  return o;
}

std::string minimise(AdapterRun& run, const DwellProblem& problem, const SolverOptions& options, const Vector& start) {
  Model model(problem, start);
  Observer observer(run, model);
  observer.evaluate();
  while (!run.stopped()) {
    const double before = run.best_value();
    const bool changed = model.hold(observer.gradient());
    ceres::Solver::Options ceres_options = options_for(options, problem.points());
    ceres_options.callbacks.push_back(&observer);
    ceres::Solver::Summary summary;
    ceres::Solve(ceres_options, &model.problem(), &summary);
    if (run.stopped()) break;
    const bool gained = before - run.best_value() > options.objective_tolerance * std::abs(before);
    if (gained || changed) continue;
    if (summary.termination_type == ceres::CONVERGENCE) run.settled(summary.message);
    return "Ceres ended with: " + summary.message;
  }
  return {};
}

}  // namespace

void CeresSolver::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  if (problem.points() > kMaxPoints) {
    throw InputError(
        fmt::format("solver = 'ceres' with {}; accepted: at most {}, as it needs the whole "
                    "matrix",
                    counted(problem.points(), "dwell point"), kMaxPoints));
  }
  AdapterRun run(problem, options_, t, summary);
  run.settle_by_evaluations(false);
  std::string reason = "no dwell points";
  if (!run.stopped() && problem.points() > 0) reason = minimise(run, problem, options_, t);
  run.finish(reason, t);
}

}  // namespace dwell
