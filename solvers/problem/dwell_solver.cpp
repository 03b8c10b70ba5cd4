#include "solvers/problem/dwell_solver.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "core/base/errors.h"
#include "solvers/matched/auto_solver.h"
#include "solvers/native/dense_nnls.h"
#include "solvers/native/projected_cg.h"
#include "solvers/native/projected_lbfgs.h"
#include "solvers/native/spectral_projected_gradient.h"
#include "solvers/peers/ceres_solver.h"
#include "solvers/peers/fourier_deconvolution.h"
#include "solvers/peers/lbfgsb_solver.h"
#include "solvers/peers/nlopt_solver.h"

namespace dwell {

std::string to_string(SolverKind kind) {
  switch (kind) {
    case SolverKind::Auto:
      return "auto";
    case SolverKind::SpectralProjectedGradient:
      return "spectral-projected-gradient";
    case SolverKind::ProjectedCg:
      return "projected-cg";
    case SolverKind::ProjectedLbfgs:
      return "projected-lbfgs";
    case SolverKind::DenseNnls:
      return "dense-nnls";
    case SolverKind::Ceres:
      return "ceres";
    case SolverKind::Lbfgsb:
      return "lbfgsb";
    case SolverKind::NloptLbfgs:
      return "nlopt-lbfgs";
    case SolverKind::NloptMma:
      return "nlopt-mma";
    case SolverKind::NloptTnewton:
      return "nlopt-tnewton";
    case SolverKind::NloptSlsqp:
      return "nlopt-slsqp";
    case SolverKind::Fourier:
      return "fourier";
  }
  return "unknown";
}

const std::vector<SolverKind>& solver_kinds() {
  static const std::vector<SolverKind> kKinds{SolverKind::Auto,        SolverKind::SpectralProjectedGradient,
                                              SolverKind::ProjectedCg, SolverKind::ProjectedLbfgs,
                                              SolverKind::DenseNnls,   SolverKind::Ceres,
                                              SolverKind::Lbfgsb,      SolverKind::NloptLbfgs,
                                              SolverKind::NloptMma,    SolverKind::NloptTnewton,
                                              SolverKind::NloptSlsqp,  SolverKind::Fourier};
  return kKinds;
}

SolverKind parse_solver_kind(const std::string& text) {
  std::string accepted;
  for (SolverKind kind : solver_kinds()) {
    if (text == to_string(kind)) return kind;
    accepted += (accepted.empty() ? "" : ", ") + to_string(kind);
  }
  throw InputError(fmt::format("solver = '{}'; accepted: {}", text, accepted));
}

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
    throw std::invalid_argument(
        fmt::format("start has {} values; the problem has {} points", t.size(), problem.points()));
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

std::unique_ptr<DwellSolver> make_solver(const SolverOptions& options) {
  validate(options);
  switch (options.kind) {
    case SolverKind::Auto:
      return std::make_unique<AutoSolver>(options);
    case SolverKind::SpectralProjectedGradient:
      return std::make_unique<SpectralProjectedGradient>(options);
    case SolverKind::ProjectedCg:
      return std::make_unique<ProjectedCg>(options);
    case SolverKind::ProjectedLbfgs:
      return std::make_unique<ProjectedLbfgs>(options);
    case SolverKind::DenseNnls:
      return std::make_unique<DenseNnls>(options);
    case SolverKind::Ceres:
      return std::make_unique<CeresSolver>(options);
    case SolverKind::Lbfgsb:
      return std::make_unique<LbfgsbSolver>(options);
    case SolverKind::NloptLbfgs:
    case SolverKind::NloptMma:
    case SolverKind::NloptTnewton:
    case SolverKind::NloptSlsqp:
      return std::make_unique<NloptSolver>(options);
    case SolverKind::Fourier:
      return std::make_unique<FourierDeconvolution>(options);
  }
  throw InputError("SolverOptions.kind is not a known solver");
}

}  // namespace dwell
