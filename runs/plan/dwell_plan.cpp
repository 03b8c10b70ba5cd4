#include "runs/plan/dwell_plan.h"

#include <fmt/format.h>

#include <utility>

#include "core/removal/simulate.h"
#include "paths/feed/plan_program.h"
#include "runs/plan/plan_problem.h"
#include "runs/plan/program_prediction.h"
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

/// The exact residual of dwell times.
ExactResidual exact_residual_of(const Part& part, const LaidPath& laid, const Vector& dwell, const HeightMap& left,
                                double max_feed, const Progress& progress) {
  const std::vector<double> seconds(dwell.data(), dwell.data() + dwell.size());
  if (laid.motion == Motion::Stop) {
    RemovingSteps steps =
        removing_steps(program_of(laid.path, std::vector<double>(seconds.size(), 0.0), laid.motion, max_feed));
    steps.strokes.insert(steps.strokes.end(), laid.strokes.begin(), laid.strokes.end());
    steps.seconds.insert(steps.seconds.end(), seconds.begin(), seconds.end());
    return exact_residual(RemovalProbe(part.map.grid, part.exact, steps.strokes, steps.seconds), part.map, left,
                          part.form, part.threads, progress);
  }
  return exact_residual(RemovalProbe(part.map.grid, part.exact, laid.strokes, seconds), part.map, left, part.form,
                        part.threads, progress);
}

/// Solves on one lattice.
DwellPlan find_dwell_on(const LatticeChoice& lattice, const Part& part, const LaidPath& laid,
                        const DwellOptions& options, Vector start, const Progress& progress) {
  DwellPlan plan;
  plan.lattice = lattice;
  if (weights_are_searched(options)) plan.search.emplace();
  progress.step("solve: setting up the removal operator");
  PlanProblem problem(part, laid, lattice.kernel, options, progress.of_part("solve"));
  progress.check();
  WeightedDwell found = plan.search ? choose_weights(problem, options, progress, *plan.search)
                                    : problem.solve({options.smoothness.value, options.time_price.value},
                                                    std::move(start), options.max_seconds, "solve", progress);
  plan.weights = found.weights;
  plan.seconds = std::move(found.dwell);
  plan.solver = std::move(found.solver);
  plan.step_rms = found.trade_off.step_rms;
  progress.step("solve: certificate");
  plan.certificate = certify(problem.with(plan.weights), plan.seconds);
  progress.check();
  const HeightMap left = problem.left_by(plan.seconds);
  plan.residual = map_statistics(left, part.form, part.threads);
  plan.exact = exact_residual_of(part, laid, plan.seconds, left, options.machine.feed_limits().max_feed,
                                 progress.of_part("exact residual"));
  collect_limits(plan, options);
  return plan;
}

}  // namespace

DwellPlan find_dwell(const Part& part, const LaidPath& laid, const DwellOptions& options, const Progress& progress) {
  constexpr int kMostLattices = 3;
  LatticeChoice lattice = choose_lattice(part, laid.strokes, progress.of_part("lattice"));
  // A Fourier deconvolution works on the map's own pixels.
  if (options.solver == SolverKind::Fourier) lattice = {part.kernel, lattice.error, true};
  const auto too_coarse = [&part](const DwellPlan& plan) { return lattice_too_coarse(plan.exact, part.before); };
  DwellOptions rest = options;
  DwellPlan plan = find_dwell_on(lattice, part, laid, rest, {}, progress);
  double seconds = plan.solver.seconds;
  for (int lattices = 2; lattices <= kMostLattices && too_coarse(plan) && !plan.lattice.finest; ++lattices) {
    rest.max_seconds = options.max_seconds - seconds;
    if (!(rest.max_seconds > 0.0)) break;
    plan = find_dwell_on(finer_lattice(part, plan.lattice), part, laid, rest, std::move(plan.seconds), progress);
    plan.lattices = lattices;
    seconds += plan.solver.seconds;
    plan.solver.seconds = seconds;
  }
  if (too_coarse(plan)) {
    plan.limits.push_back(fmt::format(
        "the removal function is too sharp for the lattice of the removal operator ({} x {} cells a pixel): its error "
        "of {:.3g} nm RMS is more than {:.0f} % of the {:.4g} nm that are left",
        plan.lattice.kernel.division.x, plan.lattice.kernel.division.y, plan.exact.lattice_error,
        100.0 * kWorstLatticeError, plan.exact.statistics.rms_about_zero()));
  }
  return plan;
}

}  // namespace dwell
