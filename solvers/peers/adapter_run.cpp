#include "solvers/peers/adapter_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dwell {

AdapterRun::AdapterRun(const DwellProblem& problem, const SolverOptions& options, const Vector& start,
                       SolverSummary& summary)
    : problem_(problem),
      options_(options),
      summary_(summary),
      objective_(problem),
      best_(start),
      value_(std::numeric_limits<double>::infinity()),
      best_value_(value_),
      checkpoint_(value_) {
  if (objective_.gradient_scale() > 0.0) scale_ = objective_.gradient_scale();
  if (options_.max_iterations == 0) ask_limits();
}

double AdapterRun::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void AdapterRun::stop(SolverStatus status, std::string message) {
  summary_.status = status;
  summary_.message = std::move(message);
}

void AdapterRun::move_to_bounds(Vector& t) const {
  clip_to_bounds(problem_, t);
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();
  for (Index j = 0; j < t.size(); ++j) {
    const double l = problem_.lower[j], u = problem_.upper_at(j);
    if (t[j] - l <= kRounding * std::abs(l)) t[j] = l;
    if (std::isfinite(u) && u - t[j] <= kRounding * std::max(std::abs(l), std::abs(u))) t[j] = u;
  }
}

double AdapterRun::evaluate(Vector& t, Vector& gradient) {
  if (stopped()) {
    gradient.setZero(t.size());
    return value_;
  }
  move_to_bounds(t);
  objective_.residual(t, residual_);
  objective_.gradient(residual_, t, gradient);
  value_ = objective_.value(residual_, t);
  project_gradient(problem_, t, gradient, projected_);
  gradient_norm_ = projected_.norm() / scale_;
  if (value_ <= best_value_) {  // at equal values the later point, whose gradient is the one that is judged
    best_value_ = value_;
    best_ = t;
  }
  ++summary_.iterations;
  const double mean_square = residual_.squaredNorm() / static_cast<double>(std::max<Index>(1, residual_.size()));
  if (options_.progress &&
      !options_.progress({summary_.iterations, 0.0, seconds(), best_value_, std::sqrt(mean_square)})) {
    stop(SolverStatus::Interrupted, fmt::format("interrupted after {} iterations", summary_.iterations));
  } else if (gradient_norm_ <= options_.gradient_tolerance && value_ <= best_value_) {
    stop(SolverStatus::Converged, fmt::format("converged: |pg| {:.3g} <= {:.3g} |A'z| after {} iterations",
                                              gradient_norm_, options_.gradient_tolerance, summary_.iterations));
  } else {
    ask_limits();
  }
  return value_;
}

void AdapterRun::ask_limits() {
  if (summary_.iterations >= options_.max_iterations) {
    stop(SolverStatus::IterationLimit,
         fmt::format("stopped after {} iterations, objective {:.6g}", summary_.iterations, best_value_));
  } else if (seconds() >= options_.max_seconds) {
    stop(SolverStatus::TimeLimit, fmt::format("stopped after {:.1f} s and {} iterations, objective {:.6g}", seconds(),
                                              summary_.iterations, best_value_));
  } else if (settles_ && options_.objective_tolerance > 0.0 &&
             summary_.iterations - checkpoint_iteration_ >=
                 std::max(options_.settle_iterations, checkpoint_iteration_ / 2)) {
    if (checkpoint_ - best_value_ <= options_.objective_tolerance * std::abs(checkpoint_)) {
      settled(fmt::format("objective changed by less than {:.3g} of itself in {} iterations",
                          options_.objective_tolerance, summary_.iterations - checkpoint_iteration_));
    }
    checkpoint_ = best_value_;
    checkpoint_iteration_ = summary_.iterations;
  }
}

void AdapterRun::settled(const std::string& reason) {
  stop(SolverStatus::Settled, fmt::format("settled: {}; |pg| {:.3g} |A'z|", reason, gradient_norm_));
}

void AdapterRun::finish(const std::string& reason, Vector& t) {
  if (!stopped()) {
    // One more look at the best point: the last one evaluated may be another.
    Vector point = best_, gradient;
    evaluate(point, gradient);
    if (!stopped() || summary_.status == SolverStatus::Settled) {
      stop(SolverStatus::Stalled, fmt::format("stalled after {} iterations: {}; |pg| {:.3g} |A'z|", summary_.iterations,
                                              reason, gradient_norm_));
    }
  }
  t = best_;
  clip_to_bounds(problem_, t);
  if (!std::isfinite(best_value_)) {
    // Nothing was evaluated: the start is what there is.
    objective_.residual(t, residual_);
    best_value_ = objective_.value(residual_, t);
  }
  summary_.objective = best_value_;
}

double AdapterRun::dwell_scale(const Vector& start) {
  Vector gradient, image;
  objective_.residual(start, residual_);
  objective_.gradient(residual_, start, gradient);
  project_gradient(problem_, start, gradient, projected_);
  objective_.image(projected_, image);
  const double curvature = objective_.curvature(projected_, image);
  const double scale = projected_.squaredNorm() / curvature * projected_.cwiseAbs().maxCoeff();
  return std::isfinite(scale) && scale > 0.0 ? scale : 1.0;
}

}  // namespace dwell
