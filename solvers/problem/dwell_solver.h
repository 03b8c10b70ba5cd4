#pragma once

#include <functional>
#include <string>

#include "core/base/progress.h"
#include "solvers/problem/dwell_problem.h"

namespace dwell {

/// Solvers of the dwell problem. All solve the same problem to the same certificate. What is known of each (its name,
/// what it is, how many dwell points it takes) stands in solvers/solver_catalogue.h.
enum class SolverKind {
  Auto,  // native: most of the work on pixels matched to the removal function, judged on the full problem
  SpectralProjectedGradient,  // native, matrix-free: the simplest; one operator pair and three vectors an iteration
  ProjectedCg,     // native, matrix-free: spectral projected gradient to find the face, conjugate gradients on it
  ProjectedLbfgs,  // native, matrix-free: projected quasi-Newton steps of exact length
  DenseNnls,       // Lawson-Hanson active set on the dense normal equations; small problems, oracle
  Ceres,           // Ceres, bounded least squares on the explicit matrix; small problems
  Lbfgsb,          // L-BFGS-B 3.0
  NloptLbfgs,      // NLopt LD_LBFGS
  NloptMma,        // NLopt LD_MMA
  NloptTnewton,    // NLopt LD_TNEWTON_PRECOND_RESTART
  NloptSlsqp,      // NLopt LD_SLSQP; small problems
  Fourier,         // Wiener deconvolution, clipped to the bounds: no optimum, but what many use
};

enum class SolverStatus {
  NotRun,
  Converged,  // projected gradient within tolerance
  Settled,    // objective no longer changes: the ill-posed remainder is not worth the work
  IterationLimit,
  TimeLimit,
  Interrupted,  // the progress handle said stop
  Failed,
  /// The problem has no weight that determines its answer, and the objective falls only by ever more dwell: feasible,
  /// but how far to go is for a time price or smoothness to say.
  Undetermined,
  Stalled,  // a third-party solver gave up before any of our rules was met: feasible, but no optimum within tolerance
};
std::string to_string(SolverStatus status);

/// What a solver reports while it runs.
struct SolverProgress {
  long iterations = 0;
  double coarse_pairs = 0.0;  // auto: transforms on coarser pixels so far, in operator pairs of the full problem
  double seconds = 0.0;
  double objective = 0.0;     // [nm^2]
  double residual_rms = 0.0;  // [nm]
};

struct SolverOptions {
  SolverKind kind = SolverKind::Auto;

  /// Converged when |projected gradient| <= gradient_tolerance * |A' W P z|. Relative; > 0.
  double gradient_tolerance = 1e-6;
  /// Settled when half as much work again (at least `settle_iterations` iterations) lowers the objective by less than
  /// this share of itself. Relative; >= 0. The problem is ill-posed: the objective goes on falling, ever slower, long
  /// after the residual has stopped changing and while the gradient is still far from its tolerance.
  double objective_tolerance = 5e-3;
  long settle_iterations = 20;  // not for the coarse rounds of auto, which have rules of their own
  /// Iterations, each one operator pair (one apply, one adjoint); coarse work counts by its transforms. >= 0; 0 leaves
  /// the start unchanged.
  long max_iterations = 2000;
  /// Wall clock [s]; > 0.
  double max_seconds = 3600.0;
  /// It is shown a line and asked whether to stop once an iteration, and four times a second within long ones.
  Progress progress{};
  /// It gets the numbers whenever `progress` gets a line, just before it. May be empty.
  std::function<void(const SolverProgress&)> trace{};
};

/// Throws InputError naming the option, its value and what is required.
void validate(const SolverOptions& options);

struct SolverSummary {
  SolverKind kind = SolverKind::Auto;
  SolverStatus status = SolverStatus::NotRun;
  long iterations = 0;
  long operator_applications = 0;  // applies plus adjoints
  double coarse_pairs = 0.0;       // auto: transforms on coarser pixels, in operator pairs of the full problem
  double seconds = 0.0;
  double objective = 0.0;
  std::string message = "not run";

  /// t is feasible and finite and no worse than the start.
  bool usable() const { return status != SolverStatus::NotRun && status != SolverStatus::Failed; }
  /// The answer is an optimum within the options' tolerances.
  bool converged() const { return status == SolverStatus::Converged || status == SolverStatus::Settled; }
};

/// One narrow interface. Not thread-safe: a problem's operator owns its workspace.
class DwellSolver {
 public:
  virtual ~DwellSolver() = default;

  /// Solves from t (warm start, clipped to the bounds; empty = the lower bound) and overwrites it. Throws
  /// std::invalid_argument if the problem or t is not valid.
  SolverSummary solve(const DwellProblem& problem, Vector& t);

 protected:
  explicit DwellSolver(SolverOptions options) : options_(std::move(options)) {}
  SolverOptions options_;

 private:
  virtual void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) = 0;
};

}  // namespace dwell
