#include "solvers/problem/solve_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dwell {

void SolveLimits::stop(SolverStatus status, std::string message) {
  summary_.status = status;
  summary_.message = std::move(message);
}

double SolveLimits::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

bool SolveLimits::allow(double value) {
  if (stopped()) return false;
  if (!std::isfinite(value)) {
    stop(SolverStatus::Failed, fmt::format("failed: objective {} after {} iterations", value, summary_.iterations));
    return false;
  }
  const double work = static_cast<double>(summary_.iterations) + summary_.coarse_pairs;
  if (work >= static_cast<double>(options_.max_iterations)) {
    stop(SolverStatus::IterationLimit,
         fmt::format("stopped after {} iterations, objective {:.6g}", summary_.iterations, value));
  } else if (seconds() >= options_.max_seconds) {
    stop(SolverStatus::TimeLimit, fmt::format("stopped after {:.1f} s and {} iterations, objective {:.6g}", seconds(),
                                              summary_.iterations, value));
  }
  return !stopped();
}

bool SolveLimits::count_iteration(const Vector& t, double value) {
  ++summary_.iterations;
  if (options_.progress && !stopped()) {
    residual_rms_ = std::sqrt(std::max(0.0, 2.0 * (value - penalty(problem_, t))) /
                              static_cast<double>(std::max<Index>(1, problem_.pixels())));
    report(value);
  }
  return allow(value);
}

bool SolveLimits::poll(double value) {
  constexpr double kQuarterSecond = 0.25;
  if (options_.progress && !stopped() && seconds() - reported_seconds_ >= kQuarterSecond) report(value);
  return allow(value);
}

void SolveLimits::report(double value) {
  reported_seconds_ = seconds();
  if (!options_.progress({summary_.iterations, summary_.coarse_pairs, reported_seconds_, value, residual_rms_}))
    stop(SolverStatus::Interrupted, fmt::format("interrupted after {} iterations", summary_.iterations));
}

bool SolveLimits::converged(double projected_gradient, double scale) {
  if (!std::isfinite(projected_gradient)) {
    stop(SolverStatus::Failed,
         fmt::format("failed: |pg| {} after {} iterations", projected_gradient, summary_.iterations));
    return true;
  }
  if (!(projected_gradient <= options_.gradient_tolerance * scale)) return false;
  stop(SolverStatus::Converged,
       fmt::format("converged: |pg| {:.3g} <= {:.3g} |A'z| after {} iterations", projected_gradient / scale,
                   options_.gradient_tolerance, summary_.iterations));
  return true;
}

}  // namespace dwell
