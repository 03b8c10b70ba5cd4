#include "solvers/problem/stopping_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"

namespace dwell {

namespace {

/// Whether nothing but the surface counts.
bool has_no_weights(const DwellProblem& problem) {
  const bool smooth = std::any_of(problem.parts.begin(), problem.parts.end(),
                                  [&](const DwellPart& part) { return problem.alpha_of(part) > 0.0; });
  return !smooth && problem.beta == 0.0 && problem.gamma == 0.0;
}

}  // namespace

StoppingRules::StoppingRules(const DwellProblem& problem, const SolverOptions& options, SolverSummary& summary)
    : problem_(problem), options_(options), summary_(summary), weightless_(has_no_weights(problem)) {}

void StoppingRules::start(double gradient_scale, double value) {
  gradient_scale_ = gradient_scale > 0.0 ? gradient_scale : 1.0;
  checkpoint_ = value;
  checkpoint_iteration_ = summary_.iterations;
  summary_.objective = value;
}

void StoppingRules::stop(SolverStatus status, std::string message) {
  summary_.status = status;
  summary_.message = std::move(message);
}

double StoppingRules::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void StoppingRules::count(const Vector& t, double value) {
  ++summary_.iterations;
  summary_.objective = value;
  if (weightless_) total_ = t.sum();
  if (stopped()) return;
  if (options_.trace || options_.progress.show) {
    residual_rms_ = std::sqrt(std::max(0.0, 2.0 * (value - penalty(problem_, t))) /
                              static_cast<double>(std::max<Index>(1, problem_.pixels())));
  }
  show(value);
}

bool StoppingRules::allow(double value) {
  if (stopped()) return false;
  if (!std::isfinite(value)) {
    stop(SolverStatus::Failed,
         fmt::format("failed: objective {} after {}", value, counted(summary_.iterations, "iteration")));
    return false;
  }
  const double work = static_cast<double>(summary_.iterations) + summary_.coarse_pairs;
  if (work >= static_cast<double>(options_.max_iterations)) {
    stop(SolverStatus::IterationLimit,
         fmt::format("stopped after {} and {:.0f} products on coarse pixels, together {} at most, objective {:.6g}",
                     counted(summary_.iterations, "iteration"), summary_.coarse_pairs, options_.max_iterations, value));
  } else if (seconds() >= options_.max_seconds) {
    stop(SolverStatus::TimeLimit, fmt::format("stopped after {:.1f} s and {}, objective {:.6g}", seconds(),
                                              counted(summary_.iterations, "iteration"), value));
  }
  return !stopped();
}

bool StoppingRules::count_iteration(const Vector& t, double value) {
  count(t, value);
  return allow(value);
}

bool StoppingRules::poll(double value) {
  constexpr double kQuarterSecond = 0.25;
  if (!stopped() && seconds() - shown_seconds_ >= kQuarterSecond) show(value);
  return allow(value);
}

void StoppingRules::show(double value) {
  shown_seconds_ = seconds();
  const SolverProgress progress{summary_.iterations, summary_.coarse_pairs, shown_seconds_, value, residual_rms_};
  if (options_.trace) options_.trace(progress);
  if (options_.progress.show) options_.progress.show(progress_line(progress));
  if (options_.progress.stop_asked())
    stop(SolverStatus::Interrupted, fmt::format("interrupted after {}", counted(summary_.iterations, "iteration")));
}

bool StoppingRules::converged(double projected_gradient) {
  if (!std::isfinite(projected_gradient)) {
    stop(SolverStatus::Failed,
         fmt::format("failed: |pg| {} after {}", projected_gradient, counted(summary_.iterations, "iteration")));
    return true;
  }
  if (!(projected_gradient <= options_.gradient_tolerance * gradient_scale_)) return false;
  stop(SolverStatus::Converged,
       fmt::format("converged: |pg| {:.3g} <= {:.3g} |A'z| after {}", projected_gradient / gradient_scale_,
                   options_.gradient_tolerance, counted(summary_.iterations, "iteration")));
  return true;
}

bool StoppingRules::cycle_is_over() const {
  // The slower the objective falls, the longer it is watched: a fixed number of iterations would stop ever earlier.
  const long watched = std::max(options_.settle_iterations, checkpoint_iteration_ / 2);
  return summary_.iterations - checkpoint_iteration_ >= watched;
}

void StoppingRules::set_checkpoint(double value) {
  checkpoint_ = value;
  checkpoint_total_ = total_;
  checkpoint_iteration_ = summary_.iterations;
}

bool StoppingRules::undetermined(double before, double value, double total_before, double total) {
  constexpr double kLeastGrowth = 0.1, kLeastWorth = 0.1;
  constexpr double kLeastWork = 0.1;  // of the most: many that are nearly so settle before
  const double work = static_cast<double>(summary_.iterations) + summary_.coarse_pairs;
  if (work < kLeastWork * static_cast<double>(options_.max_iterations)) return false;
  if (stopped() || !weightless_ || !(total_before > 0.0 && value > 0.0)) return false;
  const double grown = std::log(total / total_before), fallen = std::log(before / value);
  if (!(grown > kLeastGrowth && fallen < kLeastWorth * grown)) return false;
  stop(SolverStatus::Undetermined,
       fmt::format("with {:.3g} % more dwell the objective {:.6g} fell by {:.2g} % after {}: without smoothness and a "
                   "time price it falls on as the dwell grows, and no dwell is the answer; either of them above 0 "
                   "determines one",
                   100.0 * std::expm1(grown), value, -100.0 * std::expm1(-fallen),
                   counted(summary_.iterations, "iteration")));
  return true;
}

void StoppingRules::settle(double value, double projected_gradient) {
  stop(SolverStatus::Settled, fmt::format("settled: objective {:.6g} fell by {:.2g} of itself in {}; |pg| "
                                          "{:.2g}",
                                          value, checkpoint_ > 0.0 ? (checkpoint_ - value) / checkpoint_ : 0.0,
                                          counted(summary_.iterations - checkpoint_iteration_, "iteration"),
                                          projected_gradient / gradient_scale_));
}

void StoppingRules::stop_at_rest(double value, double projected_gradient) {
  stop(SolverStatus::Settled, fmt::format("settled: objective {:.6g} falls no more in rounding; |pg| {:.2g}", value,
                                          projected_gradient / gradient_scale_));
}

std::string progress_line(const SolverProgress& progress) {
  if (progress.iterations == 0) return fmt::format("before the first iteration, {:.1f} s", progress.seconds);
  return fmt::format("iteration {}, residual {:.4g} nm RMS, {:.1f} s", progress.iterations, progress.residual_rms,
                     progress.seconds);
}

}  // namespace dwell
