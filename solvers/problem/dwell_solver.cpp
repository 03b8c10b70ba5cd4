#include "solvers/problem/dwell_solver.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "core/base/counted.h"
#include "core/base/errors.h"

namespace dwell {

std::string to_string(SolverStatus status) {
  switch (status) {
    case SolverStatus::NotRun:
      return "not run";
    case SolverStatus::Converged:
      return "converged";
    case SolverStatus::Settled:
      return "settled";
    case SolverStatus::IterationLimit:
      return "iteration limit";
    case SolverStatus::TimeLimit:
      return "time limit";
    case SolverStatus::Interrupted:
      return "interrupted";
    case SolverStatus::Failed:
      return "failed";
    case SolverStatus::Undetermined:
      return "undetermined";
    case SolverStatus::Stalled:
      return "stalled";
  }
  return "unknown";
}

void validate(const SolverOptions& o) {
  const auto reject = [](const char* name, auto value, const char* required) {
    throw InputError(fmt::format("SolverOptions.{} = {}; required {}", name, value, required));
  };
  if (!(std::isfinite(o.gradient_tolerance) && o.gradient_tolerance > 0.0))
    reject("gradient_tolerance", o.gradient_tolerance, "> 0");
  if (!(std::isfinite(o.objective_tolerance) && o.objective_tolerance >= 0.0))
    reject("objective_tolerance", o.objective_tolerance, ">= 0");
  if (!(o.settle_iterations >= 1)) reject("settle_iterations", o.settle_iterations, ">= 1");
  if (!(o.max_iterations >= 0)) reject("max_iterations", o.max_iterations, ">= 0");
  if (!(o.max_seconds > 0.0)) reject("max_seconds", o.max_seconds, "> 0");
}

SolverSummary DwellSolver::solve(const DwellProblem& problem, Vector& t) {
  validate(problem);
  if (t.size() == 0) t = problem.lower;
  if (t.size() != problem.points()) {
    throw std::invalid_argument(fmt::format("start has {}; the problem has {}", counted(t.size(), "value"),
                                            counted(problem.points(), "point")));
  }
  if (!t.allFinite()) throw std::invalid_argument("start has a value that is not finite");
  clip_to_bounds(problem, t);

  SolverSummary summary;
  summary.kind = options_.kind;
  const auto begin = std::chrono::steady_clock::now();
  const long before = problem.removal->applications();
  do_solve(problem, t, summary);
  summary.operator_applications = problem.removal->applications() - before;
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!t.allFinite() || !std::isfinite(summary.objective)) {
    summary.status = SolverStatus::Failed;
    summary.message = "failed: the dwell or its objective is not finite";
  }
  return summary;
}

}  // namespace dwell
