#include "solvers/peers/adapter_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/counted.h"

namespace dwell {

AdapterRun::AdapterRun(const DwellProblem& problem, const SolverOptions& options, const Vector& start,
                       SolverSummary& summary)
    : problem_(problem),
      options_(options),
      summary_(summary),
      rules_(problem, options, summary),
      objective_(problem),
      best_(start),
      value_(std::numeric_limits<double>::infinity()),
      best_value_(value_) {
  if (options_.max_iterations > 0) return;
  objective_.residual(start, residual_);
  best_value_ = objective_.value(residual_, start);
  rules_.allow(best_value_);
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
  gradient_norm_ = projected_.norm();
  const bool best = value_ <= best_value_;  // at equal values the later point, whose gradient is the one that is judged
  if (best) {
    best_value_ = value_;
    best_ = t;
  }
  if (summary_.iterations == 0) rules_.start(objective_.gradient_scale(), best_value_);
  rules_.count(best_, best_value_);
  if (stopped() || (best && rules_.converged(gradient_norm_)) || !rules_.allow(best_value_)) return value_;
  if (settles_ && options_.objective_tolerance > 0.0) rules_.settled(best_value_, [&] { return gradient_norm_; });
  return value_;
}

void AdapterRun::settled(const std::string& reason) {
  rules_.stop(SolverStatus::Settled,
              fmt::format("settled: {}; |pg| {:.2g}", reason, gradient_norm_ / rules_.gradient_scale()));
}

void AdapterRun::finish(const std::string& reason, Vector& t) {
  if (!stopped()) {
    // One more look at the best point: the last one evaluated may be another.
    Vector point = best_, gradient;
    evaluate(point, gradient);
    if (!stopped() || summary_.status == SolverStatus::Settled) {
      rules_.stop(SolverStatus::Stalled,
                  fmt::format("stalled after {}: {}; |pg| {:.2g}", counted(summary_.iterations, "iteration"), reason,
                              gradient_norm_ / rules_.gradient_scale()));
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
