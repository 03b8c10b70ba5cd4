#include "runs/plan/kept_dwell.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/errors.h"
#include "core/form/map_statistics.h"
#include "core/removal/simulate.h"
#include "paths/feed/execution.h"
#include "paths/feed/late_motion.h"
#include "paths/feed/stroke_moves.h"
#include "runs/plan/lattice_choice.h"
#include "runs/plan/least_dwell_of.h"
#include "runs/plan/plan_problem.h"
#include "runs/plan/program_prediction.h"
#include "solvers/problem/certificate.h"

namespace dwell {
namespace {

/// The steps of a laid path at the feeds that are commanded.
Program program_of_strokes(const StrokeMoves& moves, const std::vector<double>& commanded, double max_feed) {
  Program program;
  program.fastest_feed = max_feed;
  program.steps = moves.steps;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    ProgramStep& step = program.steps[i];
    if (moves.stroke[i] != StrokeMoves::kNoStroke) {
      step.seconds = moves.share[i] * commanded[static_cast<std::size_t>(moves.stroke[i])];
    } else if (step.removes) {
      step.seconds = step.length() / max_feed;
    }
  }
  return program;
}

/// What the machine makes of the feeds.
MotionPlan motion_of(const Part& part, const LaidPath& laid, const RemovalKernel& kernel, const DwellOptions& options,
                     const std::vector<double>& commanded, const Progress& progress) {
  constexpr double kAtLeast = 1e-9;  // of the least dwell
  const StrokeMoves moves = stroke_moves(laid.path, laid.motion);
  const Program program = program_of_strokes(moves, commanded, options.machine.feed_limits().max_feed);
  const Execution execution = execute(program, *options.machine.machine, progress);
  MotionPlan plan;
  plan.commanded = commanded;
  plan.seconds = sum_of_strokes(moves.stroke, execution.seconds, moves.strokes);
  const HeightMap left = surface_after(part.map, simulate(execution.motion, part.map, kernel, part.threads));
  plan.rounds = {map_statistics(left, part.form, part.threads).rms_about_zero()};
  const Eigen::VectorXd least = least_dwell_of(laid, options.machine);
  plan.at_least = (plan.seconds.array() <= least.array() * (1.0 + kAtLeast)).count();
  return plan;
}

}  // namespace

DwellPlan keep_dwell(const Part& part, const LaidPath& laid, const DwellOptions& options, const Weights& weights,
                     const std::vector<double>& commanded, const Progress& progress) {
  if (commanded.size() != laid.strokes.size()) {
    throw InputError(
        fmt::format("{} dwell times for {} dwell points; required one each", commanded.size(), laid.strokes.size()));
  }
  DwellPlan plan;
  plan.lattice = choose_lattice(part, laid.strokes, progress.of_part("lattice"));
  plan.weights = weights;
  plan.seconds = Vector::Map(commanded.data(), static_cast<Index>(commanded.size()));
  if (options.machine.machine) {
    plan.motion = motion_of(part, laid, plan.lattice.kernel, options, commanded, progress);
    plan.motion->time_price = weights.time_price;
    plan.seconds = plan.motion->seconds;
  }
  progress.step("kept dwell: what it leaves");
  PlanProblem problem(part, laid, plan.lattice.kernel, options, progress.of_part("kept dwell"));
  plan.certificate = certify(problem.with(weights), plan.seconds);
  plan.step_rms = step_rms(problem.with(weights), plan.seconds);
  plan.solver.kind = options.solver;
  plan.solver.objective = plan.certificate.objective;
  plan.solver.message = "the dwell of an earlier plan is kept";
  const HeightMap left = problem.left_by(plan.seconds);
  plan.residual = map_statistics(left, part.form, part.threads);
  plan.exact = predict_dwell(part, laid, plan.seconds, left, options.machine.feed_limits().max_feed,
                             ExactCheck::Lattice, progress.of_part("exact residual"));
  return plan;
}

}  // namespace dwell
