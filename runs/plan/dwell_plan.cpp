#include "runs/plan/dwell_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/base/time_limit.h"
#include "runs/plan/expected_solve.h"
#include "runs/plan/plan_problem.h"
#include "runs/plan/program_prediction.h"
#include "runs/plan/usual_smoothness.h"
#include "runs/plan/weight_choice.h"
#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

constexpr double kLeastSolve = 1e-9;  // s; enough for the statement that there was no time

std::string not_proven(const DwellPlan& plan, const DwellOptions& options) {
  const double gap = plan.certificate.gap();
  const std::string reached =
      std::isfinite(gap) ? fmt::format("what is proven is {:.3g} %", 100.0 * gap) : "nothing is proven";
  const bool rough = plan.weights.smoothness == 0.0 || plan.weights.time_price == 0.0;
  return fmt::format("--certify is {:.3g} %, but {}{}", 100.0 * options.certify, reached,
                     rough ? "; without smoothness or time price the bound is rough" : "");
}

void collect_limits(DwellPlan& plan, const DwellOptions& options) {
  if (!plan.solver.converged()) {
    const bool time = plan.solver.status == SolverStatus::TimeLimit;
    plan.limits.push_back(fmt::format(
        "solver {}: {}: {}{}", to_string(options.solver), to_string(plan.solver.status), plan.solver.message,
        time ? fmt::format("; `max solve` is {} s, of which {:.1f} s went before the solve", options.max_seconds,
                           plan.seconds_before_solve)
             : ""));
  }
  if (options.certify > 0.0 && !(plan.certificate.gap() <= options.certify))
    plan.limits.push_back(not_proven(plan, options));
  if (plan.motion && options.time_price.kind == GoalKind::TotalAtMost) {
    const double taken = plan.motion->seconds.sum(), most = options.time_price.value;
    constexpr double kHeld = 1e-3;
    if (!(taken <= (1.0 + kHeld) * most))
      plan.limits.push_back(
          fmt::format("`time price` is total<={:g} s, but on the machine the strokes take {:.6g} s", most, taken));
  }
  if (plan.search) plan.limits.insert(plan.limits.end(), plan.search->limits.begin(), plan.search->limits.end());
}

/// The options with numbers in place of Auto. The price is found with the smoothness that is given, or with the usual
/// one where the smoothness is searched over plans. A Fourier deconvolution knows no price.
DwellOptions with_weights(const DwellOptions& options, const Part& part, const LaidPath& laid, PlanProblem& problem,
                          DwellPlan& plan, const Progress& progress) {
  DwellOptions numbers = options;
  if (options.smoothness.kind == GoalKind::Auto) numbers.smoothness = {usual_smoothness(part, laid)};
  if (options.time_price.kind != GoalKind::Auto) return numbers;
  numbers.time_price = {0.0};
  if (options.solver == SolverKind::Fourier) return numbers;
  const double smoothness =
      numbers.smoothness.kind == GoalKind::Fixed ? numbers.smoothness.value : usual_smoothness(part, laid);
  plan.worth = problem.find_price(part, smoothness, options.time_worth, progress);
  plan.worth_smoothness = smoothness;
  numbers.time_price = {plan.worth->price};
  return numbers;
}

/// Solves on one lattice.
DwellPlan find_dwell_on(const LatticeChoice& lattice, const Part& part, const LaidPath& laid, const DwellOptions& given,
                        Vector start, ExactCheck check, const Progress& progress) {
  DwellPlan plan;
  plan.lattice = lattice;
  if (weights_are_searched(given)) plan.search.emplace();
  const TimeLimit limit = time_limit(given.max_seconds, given.used_seconds);
  DwellOptions options = given;
  const std::unique_ptr<PlanProblem> set_up = limit.run(progress, [&](const Progress& limited) {
    limited.step("solve: setting up the removal operator");
    auto problem = std::make_unique<PlanProblem>(part, laid, lattice.kernel, options, limited.of_part("solve"));
    limited.check();
    options = with_weights(given, part, laid, *problem, plan, limited.of_part("solve"));
    return problem;
  });
  PlanProblem& problem = *set_up;
  plan.seconds_before_solve = limit.used();
  const double most = std::min(options.max_seconds, std::max(limit.left(), kLeastSolve));
  const Weights weights{options.smoothness.value, options.time_price.value};
  WeightedDwell found = plan.search ? choose_weights(problem, options, most, progress, *plan.search)
                        : options.robust && start.size() > 0
                            ? solve_expected(problem, weights, start, most, plan.limits, progress)
                            : problem.solve(weights, std::move(start), most, "solve", progress);
  plan.weights = found.weights;
  progress.step("solve: certificate");
  plan.certificate = certify(problem.with(plan.weights), found.dwell);
  progress.check();
  if (options.certify > 0.0) {
    problem.prove(options.certify, std::max(limit.left(), kLeastSolve), found, plan.certificate,
                  progress.of_part("solve"));
  }
  plan.seconds = std::move(found.dwell);
  plan.solver = std::move(found.solver);
  plan.step_rms = found.trade_off.step_rms;
  const HeightMap left = problem.left_by(plan.seconds);
  plan.residual = map_statistics(left, part.form, part.threads);
  plan.exact = predict_dwell(part, laid, plan.seconds, left, options.machine.feed_limits().max_feed, check,
                             progress.of_part("exact residual"));
  if (options.machine.machine) {
    plan.motion = plan_motion(problem, part, laid, lattice.kernel, options, plan.weights, plan.seconds, progress);
  }
  collect_limits(plan, options);
  return plan;
}

}  // namespace

DwellPlan find_dwell(const Part& part, const LaidPath& laid, const DwellOptions& options, const Progress& progress,
                     ExactCheck check, Vector start) {
  constexpr int kMostLattices = 3;
  const TimeLimit limit = time_limit(options.max_seconds, options.used_seconds);
  LatticeChoice lattice = limit.run(progress, [&](const Progress& limited) {
    return choose_lattice(part, laid.strokes, limited.of_part("lattice"));
  });
  // A Fourier deconvolution works on the map's own pixels.
  if (options.solver == SolverKind::Fourier) lattice = {part.kernel, lattice.error, true};
  const auto too_coarse = [&part](const DwellPlan& plan) { return lattice_too_coarse(plan.exact, part.before); };
  DwellOptions rest = options;
  rest.used_seconds = limit.used();
  DwellPlan plan = find_dwell_on(lattice, part, laid, rest, std::move(start), check, progress);
  for (int lattices = 2; lattices <= kMostLattices && too_coarse(plan) && !plan.lattice.finest; ++lattices) {
    rest.used_seconds = limit.used();
    if (!(limit.left() > 0.0)) break;
    const double seconds = plan.solver.seconds;
    if (!plan.search) {  // what the weights are does not depend on the lattice
      rest.smoothness = {plan.weights.smoothness};
      rest.time_price = {plan.weights.time_price};
    }
    const std::optional<TimePrice> worth = plan.worth;
    const double worth_smoothness = plan.worth_smoothness;
    try {
      plan = find_dwell_on(finer_lattice(part, plan.lattice), part, laid, rest, plan.seconds, check, progress);
      plan.worth = worth;
      plan.worth_smoothness = worth_smoothness;
    } catch (const TimeLimitReached&) {
      break;  // the plan on the coarser lattice stands, and what follows says how wrong it is
    }
    plan.lattices = lattices;
    plan.solver.seconds += seconds;
  }
  if (too_coarse(plan)) {
    plan.limits.push_back(
        fmt::format("the removal function is too sharp for the lattice of the removal operator ({}): its error "
                    "of {:.3g} nm RMS is more than {:.0f} % of the {:.4g} nm{} that are left",
                    lattice_words(plan.lattice.kernel), plan.exact.lattice_error, 100.0 * kWorstLatticeError,
                    plan.exact.statistics.rms_about_zero(), about_zero_in_words(plan.exact.statistics)));
  }
  return plan;
}

}  // namespace dwell
