#include "runs/plan/dwell_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/time_limit.h"
#include "runs/plan/plan_problem.h"
#include "runs/plan/weight_choice.h"
#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

constexpr double kLeastSolve = 1e-9;  // s; enough for the statement that there was no time

void collect_limits(DwellPlan& plan, const DwellOptions& options) {
  if (!plan.solver.converged()) {
    const bool time = plan.solver.status == SolverStatus::TimeLimit;
    plan.limits.push_back(fmt::format(
        "solver {}: {}: {}{}", to_string(options.solver), to_string(plan.solver.status), plan.solver.message,
        time ? fmt::format("; `max solve` is {} s, of which {:.1f} s went before the solve", options.max_seconds,
                           plan.seconds_before_solve)
             : ""));
  }
  if (plan.search) plan.limits.insert(plan.limits.end(), plan.search->limits.begin(), plan.search->limits.end());
}

}  // namespace

DwellPlan find_dwell(const Part& part, const LaidPath& laid, const DwellOptions& options, const Progress& progress) {
  DwellPlan plan;
  if (weights_are_searched(options)) plan.search.emplace();
  const TimeLimit limit = time_limit(options.max_seconds, options.used_seconds);
  const std::unique_ptr<PlanProblem> set_up = limit.run(progress, [&](const Progress& limited) {
    limited.step("solve: setting up the removal operator");
    auto problem = std::make_unique<PlanProblem>(part, laid, options, limited.of_part("solve"));
    limited.check();
    return problem;
  });
  PlanProblem& problem = *set_up;
  plan.seconds_before_solve = limit.used();
  const double left = std::min(options.max_seconds, std::max(limit.left(), kLeastSolve));
  WeightedDwell found =
      plan.search ? choose_weights(problem, options, left, progress, *plan.search)
                  : problem.solve({options.smoothness.value, options.time_price.value}, {}, left, "solve", progress);
  plan.weights = found.weights;
  plan.seconds = std::move(found.dwell);
  plan.solver = std::move(found.solver);
  plan.step_rms = found.trade_off.step_rms;
  progress.step("solve: certificate");
  plan.certificate = certify(problem.with(plan.weights), plan.seconds);
  progress.check();
  plan.residual = map_statistics(problem.left_by(plan.seconds), part.form, part.threads);
  collect_limits(plan, options);
  return plan;
}

}  // namespace dwell
