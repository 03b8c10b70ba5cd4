#include "solvers/fits/ceres_removal_fit.h"

#include <Eigen/Core>
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/numerics/dense_solve.h"
#include "core/numerics/median.h"
#include "core/tif/models/removal_models.h"
#include "solvers/fits/removal_fit_starts.h"
#include "solvers/fits/stop_callback.h"

namespace dwell {
namespace {

constexpr std::size_t kOwn = 3;                 // x, y, peak come before the model's own parameters
constexpr std::size_t kScreeningPixels = 4000;  // on which the starts are tried

struct RateSample {
  Point place;
  double rate;
};

/// Residuals of a model at samples; with a scale k > 0 each is r sqrt(2 / (sqrt(1 + r^2/k^2) + 1)), half of whose
/// square is the soft L1 loss.
class ModelResiduals {
 public:
  ModelResiduals(const RemovalModel& model, const std::vector<RateSample>& samples, double blur, double scale,
                 const Progress& progress)
      : model_(model), samples_(samples), blur_(blur), scale_(scale), progress_(progress) {}

  bool operator()(double const* const* parameters, double* residuals) const {
    const double* p = parameters[0];
    RemovalShape shape;
    try {
      shape = model_.shape({p + kOwn, model_.parameters.size()}, blur_);
    } catch (const InputError&) {
      return false;  // out of the model's range: a shorter step is tried
    }
    const double factor = p[2] / shape.peak;
    constexpr std::size_t kBetweenLooks = 4096;  // of 20 us at most
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      // Any numbers will do, as solve_with_stop then throws; of a failed evaluation Ceres would write a line.
      if (i % kBetweenLooks == 0 && progress_.stop_asked()) {
        std::fill(residuals, residuals + samples_.size(), 0.0);
        return true;
      }
      const double r = samples_[i].rate - factor * shape.value(samples_[i].place - Point{p[0], p[1]});
      const double q = r / scale_;
      residuals[i] = scale_ > 0.0 ? r * std::sqrt(2.0 / (std::sqrt(1.0 + q * q) + 1.0)) : r;
    }
    return true;
  }

 private:
  const RemovalModel& model_;
  const std::vector<RateSample>& samples_;
  double blur_, scale_;
  const Progress& progress_;
};

/// The fit of one model, from start to numbers.
class ModelFit {
 public:
  ModelFit(const HeightMap& rates, const RemovalModel& model, const RemovalFitOptions& options,
           const Progress& progress)
      : rates_(rates), model_(model), progress_(progress), blur_(std::max(rates.grid.pitch_x, rates.grid.pitch_y)) {
    for (const Index i : finite_pixels(rates))
      samples_.push_back({rates.grid.centre(i), rates.values[static_cast<std::size_t>(i)]});
    const std::size_t step = samples_.size() / kScreeningPixels + 1;
    for (std::size_t i = 0; i < samples_.size(); i += step) few_.push_back(samples_[i]);
    name_parameters();
    hold(options);
    if (samples_.size() <= values_.size()) {
      throw InputError(fmt::format("fit of {}: {} for {} parameters; more are required", model.name,
                                   counted(samples_.size(), "sample"), values_.size()));
    }
    starts_ = removal_fit_starts(rates, model);
  }

  RemovalFit run(bool robust) {
    choose_start();
    ceres::Solver::Summary summary = minimise(samples_, 0.0, 200);
    if (robust) {
      scale_ = 1.345 * scatter();
      if (scale_ > 0.0) summary = minimise(samples_, scale_, 200);
    }
    return result(summary);
  }

 private:
  void name_parameters() {
    parameters_ = {{"x", "mm", 0, 0, false}, {"y", "mm", 0, 0, false}, {"peak", "nm/s", 0, 0, false}};
    for (const ModelParameter& p : model_.parameters) parameters_.push_back({p.name, p.unit, 0.0, 0.0, !p.fitted});
    values_.assign(parameters_.size(), 0.0);
    given_.assign(parameters_.size(), std::numeric_limits<double>::quiet_NaN());
  }

  void hold(const RemovalFitOptions& options) {
    for (const auto& entry : options.held) {
      const std::string& name = entry.first;
      const double value = entry.second;
      const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                      [&](const FittedParameter& p) { return p.name == name; });
      if (found == parameters_.end()) {
        std::string names;
        for (const FittedParameter& p : parameters_) names += (names.empty() ? "" : ", ") + p.name;
        throw InputError(fmt::format("fit of {}: unknown parameter \"{}\"; accepted: {}", model_.name, name, names));
      }
      const auto k = static_cast<std::size_t>(found - parameters_.begin());
      if (k >= kOwn) {
        check_model_parameter(model_, model_.parameters[k - kOwn], value);
      } else if (!std::isfinite(value) || (k == 2 && !(value > 0.0))) {
        throw InputError(fmt::format("fit of {}: {} = {}; a finite number{} is required", model_.name, name, value,
                                     k == 2 ? " > 0" : ""));
      }
      found->held = true;
      given_[k] = value;
    }
    for (std::size_t k = kOwn; k < parameters_.size(); ++k) {
      const ModelParameter& p = model_.parameters[k - kOwn];
      if (!p.fitted && !p.fallback && std::isnan(given_[k])) {
        throw InputError(
            fmt::format("fit of {0}: {1} must be held; `fit` {0}:{1}=VALUE is required", model_.name, p.name));
      }
      if (model_.idle != nullptr && std::isnan(given_[k]) && model_.idle(k - kOwn, std::span(given_).subspan(kOwn))) {
        parameters_[k].held = true;
        given_[k] = 0.0;
      }
    }
  }

  void take(const std::vector<double>& start) {
    values_ = start;
    for (std::size_t k = 0; k < values_.size(); ++k) {
      if (!std::isnan(given_[k])) values_[k] = given_[k];
    }
  }

  void choose_start() {
    double best = std::numeric_limits<double>::infinity();
    std::vector<double> best_values;
    for (const std::vector<double>& start : starts_) {
      take(start);
      const double cost = minimise(few_, 0.0, 15).final_cost;
      // A start that the solver could not even evaluate has a negative cost.
      if (!(cost >= 0.0 && cost < best)) continue;
      best = cost;
      best_values = values_;
    }
    if (best_values.empty()) {
      throw InputError(fmt::format("fit of {}: no start within the model's range; hold other parameters", model_.name));
    }
    values_ = best_values;
  }

  /// The problem over one block of all parameters, which `values_` holds.
  void build(ceres::Problem& problem, const std::vector<RateSample>& samples, double scale) {
    ceres::NumericDiffOptions steps;
    steps.relative_step_size = 1e-5;
    auto* cost = new ceres::DynamicNumericDiffCostFunction<ModelResiduals, ceres::CENTRAL>(
        new ModelResiduals(model_, samples, blur_, scale, progress_), ceres::TAKE_OWNERSHIP, steps);
    cost->AddParameterBlock(static_cast<int>(values_.size()));
    cost->SetNumResiduals(static_cast<int>(samples.size()));
    problem.AddResidualBlock(cost, nullptr, values_.data());
    std::vector<int> held;
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
      if (parameters_[k].held) held.push_back(static_cast<int>(k));
    }
    if (held.size() == values_.size()) {
      problem.SetParameterBlockConstant(values_.data());
    } else if (!held.empty()) {
      problem.SetManifold(values_.data(), new ceres::SubsetManifold(static_cast<int>(values_.size()), held));
    }
    for (std::size_t k = kOwn; k < values_.size(); ++k) {
      if (parameters_[k].held || parameters_[k].name == "angle") continue;
      const ModelParameter& p = model_.parameters[k - kOwn];
      const double least = p.open ? std::max(p.least, 0.02 * values_[k]) : p.least;
      problem.SetParameterLowerBound(values_.data(), static_cast<int>(k), std::min(least, values_[k]));
      problem.SetParameterUpperBound(values_.data(), static_cast<int>(k), p.most);
    }
  }

  ceres::Solver::Summary minimise(const std::vector<RateSample>& samples, double scale, int iterations) {
    ceres::Problem problem;
    build(problem, samples, scale);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = iterations;
    options.function_tolerance = 1e-12;
    options.parameter_tolerance = 1e-10;
    options.gradient_tolerance = 1e-14;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary = solve_with_stop(options, problem, progress_);
    iterations_ += static_cast<int>(summary.iterations.size());
    return summary;
  }

  std::vector<double> residuals() const {
    std::vector<double> r(samples_.size());
    const double* block = values_.data();
    if (!ModelResiduals(model_, samples_, blur_, 0.0, progress_)(&block, r.data())) {
      throw InputError(fmt::format("fit of {}: ended outside of the model's range", model_.name));
    }
    progress_.check();  // if it said stop, these are not the residuals
    return r;
  }

  /// 1.4826 times the median absolute residual; where most are zero, the RMS.
  double scatter() const {
    std::vector<double> r = residuals();
    double square = 0.0;
    for (double& v : r) square += v * v, v = std::abs(v);
    const double median = upper_median(r);
    return median > 0.0 ? kSigmaPerMedianDeviation * median : std::sqrt(square / static_cast<double>(r.size()));
  }

  /// The noise variance that goes with (J'J)^-1: see the header.
  double noise_variance(const std::vector<double>& r, Index free) const {
    const double n = static_cast<double>(r.size());
    double psi2 = 0.0, slope = 0.0;
    for (const double v : r) {
      const double q = scale_ > 0.0 ? 1.0 + v * v / (scale_ * scale_) : 1.0;
      psi2 += v * v / q;
      slope += std::pow(q, -1.5);
    }
    return psi2 / (n - static_cast<double>(free)) / std::pow(slope / n, 2);
  }

  void find_errors(const std::vector<double>& r) {
    std::vector<std::size_t> free;
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
      if (!parameters_[k].held) free.push_back(k);
    }
    if (free.empty()) return;
    ceres::Problem problem;
    build(problem, samples_, 0.0);
    ceres::CRSMatrix jacobian;
    problem.Evaluate({}, nullptr, nullptr, nullptr, &jacobian);
    const auto p = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(p, p);
    for (std::size_t row = 0; row + 1 < jacobian.rows.size(); ++row) {
      Eigen::VectorXd line = Eigen::VectorXd::Zero(p);
      for (int k = jacobian.rows[row]; k < jacobian.rows[row + 1]; ++k)
        line[jacobian.cols[static_cast<std::size_t>(k)]] = jacobian.values[static_cast<std::size_t>(k)];
      normal += line * line.transpose();
    }
    Eigen::VectorXd size = normal.diagonal().cwiseSqrt();
    for (double& s : size) s = s > 0.0 ? s : 1.0;
    const Eigen::VectorXd per_size = size.cwiseInverse();
    const SymmetricEigen eigen = symmetric_eigen(per_size.asDiagonal() * normal * per_size.asDiagonal());
    const double variance = noise_variance(r, p);
    for (Eigen::Index j = 0; j < p; ++j) {
      double sum = 0.0;
      for (Eigen::Index e = 0; e < p; ++e) {
        const double share = std::pow(eigen.vectors(j, e), 2), value = eigen.values[e];
        if (value > 1e-9) {
          sum += share / value;
        } else if (share > 1e-6) {
          sum = std::numeric_limits<double>::quiet_NaN();  // the samples do not determine it
        }
      }
      FittedParameter& parameter = parameters_[free[static_cast<std::size_t>(j)]];
      parameter.error = std::sqrt(variance * sum) / size[j];
      // A standard error of a quarter turn or more says that the direction is not known.
      if (parameter.unit == "deg" && parameter.error > 90.0) parameter.error = std::numeric_limits<double>::quiet_NaN();
    }
  }

  std::string spec() const {
    if (model_.spec != nullptr) return model_.spec(values_[2], std::span(values_).subspan(kOwn));
    std::string text = fmt::format("{}:peak={:.8g}", model_.name, values_[2]);
    for (std::size_t k = kOwn; k < values_.size(); ++k)
      text += fmt::format(",{}={:.8g}", parameters_[k].name, values_[k]);
    return text;
  }

  void make_canonical() {
    if (model_.make_canonical == nullptr) return;
    std::vector<bool> held;
    for (std::size_t k = kOwn; k < parameters_.size(); ++k) held.push_back(parameters_[k].held);
    model_.make_canonical(std::span(values_).subspan(kOwn), held);
  }

  RemovalFit result(const ceres::Solver::Summary& summary) {
    make_canonical();
    const std::vector<double> r = residuals();
    find_errors(r);
    RemovalFit fit;
    fit.model = model_.name;
    fit.fitted = fit.residual = rates_;
    const std::vector<Index> pixels = finite_pixels(rates_);
    double square = 0.0, mean = 0.0, about_mean = 0.0;
    for (const RateSample& s : samples_) mean += s.rate / static_cast<double>(samples_.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto pixel = static_cast<std::size_t>(pixels[i]);
      fit.residual.values[pixel] = r[i];
      fit.fitted.values[pixel] = samples_[i].rate - r[i];
      square += r[i] * r[i];
      about_mean += std::pow(samples_[i].rate - mean, 2);
    }
    const double m = static_cast<double>(samples_.size());
    Index varied = 0;
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
      parameters_[k].value = values_[k];
      varied += !parameters_[k].held;
      if (parameters_[k].name == "angle" && !parameters_[k].held)
        parameters_[k].value = std::remainder(values_[k], 360.0);
      values_[k] = parameters_[k].value;
    }
    fit.parameters = parameters_;
    fit.rms = std::sqrt(square / m);
    fit.r_squared = 1.0 - square / about_mean;
    const double likelihood = m * std::log(std::max(square / m, std::numeric_limits<double>::min()));
    fit.aic = likelihood + 2.0 * static_cast<double>(varied + 1);
    fit.bic = likelihood + std::log(m) * static_cast<double>(varied + 1);
    fit.iterations = iterations_;
    fit.converged = summary.termination_type == ceres::CONVERGENCE;
    fit.message = summary.message;
    fit.spec = spec();
    return fit;
  }

  const HeightMap& rates_;
  const RemovalModel& model_;
  const Progress& progress_;
  double blur_;
  double scale_ = 0.0;  // of the robust loss; 0: least squares
  std::vector<RateSample> samples_, few_;
  std::vector<FittedParameter> parameters_;
  std::vector<double> values_, given_;  // given: NaN where not held by the user
  std::vector<std::vector<double>> starts_;
  int iterations_ = 0;
};

}  // namespace

const FittedParameter& RemovalFit::at(const std::string& name) const {
  for (const FittedParameter& p : parameters) {
    if (p.name == name) return p;
  }
  throw std::out_of_range("no parameter " + name);
}

RemovalFit fit_removal(const HeightMap& rates, const RemovalModel& model, const RemovalFitOptions& options,
                       const Progress& progress) {
  return ModelFit(rates, model, options, progress).run(options.robust);
}

}  // namespace dwell
