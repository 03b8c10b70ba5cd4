#pragma once

#include <optional>

#include "core/base/time_limit.h"
#include "paths/feed/schedule_kind.h"
#include "runs/plan/fit_objective.h"
#include "runs/plan/machine_limits.h"
#include "runs/plan/uncertainty_spec.h"
#include "solvers/problem/dwell_solver.h"
#include "solvers/weights/time_worth.h"
#include "solvers/weights/weight_search.h"

namespace dwell {

/// How dwell times are to be found.
struct DwellOptions {
  MachineLimits machine;
  WeightGoal smoothness{0.0, GoalKind::Auto};  // weight of smooth feed against residual, dimensionless
  WeightGoal time_price{0.0, GoalKind::Auto};  // price of a second of machine time [nm^2/s]
  TimeWorth time_worth;                        // rules the time price where that is Auto
  SolverKind solver = SolverKind::Auto;
  double max_seconds = 3600.0;  // wall clock for the set-up and all solves together [s]; > 0
  double used_seconds = 0.0;    // of these, before find_dwell was called: by reading the input, planning the path
  double certify = 0.0;         // share of the optimum that the objective may be above it, proven; 0 = not asked for
  ScheduleKind schedule = ScheduleKind::Constant;  // how the program for a machine says its speeds
  bool over_path = false;                          // its speeds must be such over the path, too (path_linear.h)
  int rounds = 20;                                 // of correction for the motion of the machine, at most; >= 0
  double fraction = 1.0;                           // of the error, form terms aside, that is to be removed; > 0, <= 1
  FitObjective objective{};                        // heights, slopes or both
  std::optional<UncertaintySpec> robust{};         // the expected residual under it is made small, not the residual
};

/// The clock of max_seconds, of which `used` went before [s]. The phases before a solve have a second even where
/// max_seconds is less: so short a limit is one on the solve.
inline TimeLimit time_limit(double max_seconds, double used = 0.0) {
  constexpr double kLeastSetUp = 1.0;
  return {max_seconds, "max solve", used, kLeastSetUp};
}

/// Whether the options leave a weight to a search over plans: at its corner, or by a target. Throws InputError if both
/// weights shall be the largest that hold a residual: many pairs of weights do, and none of them is the largest.
bool weights_are_searched(const DwellOptions& options);

/// Throws InputError for weights that contradict each other, before any work is done: as weights_are_searched, for a
/// worth of time beside a price that it does not rule, and for a target in heights beside an objective with slopes.
void check_weights(const DwellOptions& options);

}  // namespace dwell
