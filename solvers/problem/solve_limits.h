#pragma once

#include <chrono>

#include "solvers/problem/box_minimiser.h"
#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// What ends a solve, shared by the native solvers: limits, the progress callback, the gradient tolerance.
class SolveLimits {
 public:
  SolveLimits(const DwellProblem& problem, const SolverOptions& options, SolverSummary& summary)
      : problem_(problem), options_(options), summary_(summary) {}

  bool stopped() const { return summary_.status != SolverStatus::NotRun; }
  void stop(SolverStatus status, std::string message);
  double seconds() const;

  /// False, and stopped, if work or time is used up.
  bool allow(double value);
  /// Counts an iteration, tells the progress callback and asks allow(). value [nm^2] belongs to dwell t.
  bool count_iteration(const Vector& t, double value);
  /// Between iterations: asks allow() and, at most every quarter of a second, the progress callback.
  bool poll(double value);
  /// True, and stopped, if |projected gradient| <= gradient_tolerance * scale.
  bool converged(double projected_gradient, double scale);

 private:
  void report(double value);

  const DwellProblem& problem_;
  const SolverOptions& options_;
  SolverSummary& summary_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double reported_seconds_ = 0.0, residual_rms_ = 0.0;
};

}  // namespace dwell
