#include "runs/plan/dwell_plan.h"

#include <fmt/format.h>

#include <utility>

#include "runs/plan/plan_problem.h"
#include "runs/plan/weight_choice.h"
#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

void collect_limits(DwellPlan& plan, const DwellOptions& options) {
  if (!plan.solver.converged()) {
    const bool time = plan.solver.status == SolverStatus::TimeLimit;
    plan.limits.push_back(fmt::format("solver {}: {}: {}{}", to_string(options.solver), to_string(plan.solver.status),
                                      plan.solver.message,
                                      time ? fmt::format("; `max solve` is {} s", options.max_seconds) : ""));
  }
  if (plan.search) plan.limits.insert(plan.limits.end(), plan.search->limits.begin(), plan.search->limits.end());
}

}  // namespace

DwellPlan find_dwell(const Part& part, const LaidPath& laid, const DwellOptions& options, const Progress& progress) {
  DwellPlan plan;
  if (weights_are_searched(options)) plan.search.emplace();
  progress.step("solve: setting up the removal operator");
  PlanProblem problem(part, laid, options, progress.of_part("solve"));
  progress.check();
  WeightedDwell found = plan.search ? choose_weights(problem, options, progress, *plan.search)
                                    : problem.solve({options.smoothness.value, options.time_price.value}, {},
                                                    options.max_seconds, "solve", progress);
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
