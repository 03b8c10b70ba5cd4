#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>

#include "bench/scenario.h"
#include "solvers/problem/dwell_solver.h"

namespace dwell::bench {

/// How good "as good as the reference" is: within these shares of its objective, and of its residual.
inline constexpr double kQualities[] = {0.1, 0.01, 0.001};
inline constexpr std::size_t kOnePercent = 1;  // in kQualities

struct Target {
  double objective = 0.0;     // of the reference [nm^2]
  double residual_rms = 0.0;  // [nm]
  double total_dwell = 0.0;   // [s]
};

struct SolveOptions {
  SolverKind kind = SolverKind::ProjectedCg;
  int threads = 1;
  ScenarioWeights weights;
  /// Without a target the run ends at the time limit or by the solver's own certificate 1e-6.
  std::optional<Target> target;
  /// Ends a run that comes within `stop_gap` of the target's objective. Else it goes on to the certificate.
  bool stop_at_target = true;
  double stop_gap = 1e-4;
  double gradient_tolerance = 1e-6;  // of the solver's own certificate
  double max_seconds = 60.0;         // for the solve
};

/// Solves a scenario once, from the lower bound. The result has
///   pair_seconds   one apply and one adjoint, the fastest of five, in this process
///   reached        for each quality: iterations, applications, coarse_pairs and seconds when the objective
///   ("objective") and the
///                  residual ("residual") first were within it; null if never
///   trace          [seconds, applications, objective, residual_rms] where the objective fell by 0.1 % since the last
///   certificate, total_dwell, status, message, iterations, applications, coarse_pairs, seconds at the end
///   step_rms       |D (t - l)| over the root of the number of links [s]
///   build_seconds  of making the instance, which is not part of any other number here
///   solve_memory   peak of the process while solving less what it held before [bytes], and peak_memory, of all
/// or "refused" with the message of a solver that does not take a problem of this size. Seconds are counted from the
/// call of solve(). If a solver takes more than twice its time limit, SIGALRM ends it with the process.
nlohmann::json solve_once(const Scenario& scenario, const SolveOptions& options);

/// One apply and one adjoint of an operator, the fastest of five [s].
double seconds_of_a_pair(RemovalOperator& removal);

}  // namespace dwell::bench
