#include "runs/plan/motion_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/form/map_statistics.h"
#include "core/removal/simulate.h"
#include "paths/feed/constant_schedule.h"
#include "paths/feed/execution.h"
#include "paths/feed/exported_motion.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/late_motion.h"
#include "paths/feed/lift_rests.h"
#include "paths/feed/linear_program.h"
#include "paths/feed/linear_schedule.h"
#include "paths/feed/stroke_moves.h"
#include "runs/plan/least_dwell_of.h"
#include "runs/plan/rounded_motion.h"
#include "runs/plan/weight_choice.h"

namespace dwell {
namespace {

constexpr double kGainsLittle = 0.002;  // a round that lowers what is left by no more than this share may be the last
constexpr double kNearPlan = 1.005;     // of what the plan leaves: no second such round is waited for
constexpr double kAtLeast = 1e-9;       // of the least dwell
constexpr double kTooShort = 1e-3;      // of the dwell, by which a stroke with speeds takes longer

class Loop {
 public:
  Loop(const Part& part, const LaidPath& laid, const RemovalKernel& kernel, const DwellOptions& options)
      : part_(part),
        learnt_(options.machine.learnt.get()),
        map_(learnt_ != nullptr ? with_learnt_removal(part, learnt_->removal).map : part.map),
        kernel_(kernel),
        machine_(*options.machine.machine),
        kind_(options.schedule),
        over_path_(options.over_path),
        max_feed_(options.machine.feed_limits().max_feed),
        moves_(stroke_moves(laid.path, laid.motion)),
        path_(kinematic_path(moves_.steps, machine_, max_feed_)),
        strokes_(laid.strokes) {}

  /// Feeds or speeds for a dwell, and the surface that the machine leaves with them.
  HeightMap execute_dwell(const Eigen::VectorXd& dwell, MotionPlan& plan, const Progress& progress) const {
    if (kind_ == ScheduleKind::Constant) return left_by(execute_feeds(dwell, plan, progress));
    plan.program = motion_to_be_rounded(
        machine_,
        [&](double acceleration_share) { return program_of_speeds(dwell, acceleration_share, plan, progress); },
        over_path_);
    plan.commanded.assign(plan.seconds.begin(), plan.seconds.end());
    plan.too_short = ((plan.seconds - dwell).array() > kTooShort * dwell.array()).count();
    return left_by(with_lift_rests(rounded_motion(*plan.program, machine_), machine_));
  }

  double rms_of(const HeightMap& left) const {
    return map_statistics(left, part_.form, part_.threads).rms_about_zero();
  }

 private:
  HeightMap left_by(const Program& motion) const {
    return surface_after(map_, simulate(motion, map_, kernel_, part_.threads));
  }

  Program program_of_speeds(const Eigen::VectorXd& dwell, double acceleration_share, MotionPlan& plan,
                            const Progress& progress) const {
    const RoundingMargins margins = margins_of(acceleration_share);
    const Machine tight = with_margins(machine_, margins);
    const KinematicPath path = kinematic_path(moves_.steps, tight, max_feed_);
    const LinearSchedule schedule = schedule_linear(moves_, path, tight, dwell, part_.threads, progress);
    plan.seconds = schedule.seconds;
    Program program = linear_program(moves_, path, schedule, tight, least_piece_seconds(machine_, margins));
    if (kind_ == ScheduleKind::Pvt) join_velocities(program);
    return program;
  }

  Program execute_feeds(const Eigen::VectorXd& dwell, MotionPlan& plan, const Progress& progress) const {
    Eigen::VectorXd of_machine = dwell;  // what is left of it to the machine's own motion
    if (learnt_ != nullptr) of_machine = (dwell - learnt_->late).cwiseMax(0.0);
    const ConstantSchedule schedule = schedule_blended(moves_, machine_, max_feed_, of_machine);
    plan.seconds = schedule.seconds;
    plan.too_short = schedule.too_short;
    plan.commanded = schedule.halt;
    for (std::size_t j = 0; j < plan.commanded.size(); ++j) {
      if (schedule.feed[j] > 0.0) plan.commanded[j] = strokes_[j].length() / schedule.feed[j];
    }
    Program program;
    program.fastest_feed = max_feed_;
    program.steps.reserve(moves_.size());
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      ProgramStep step = moves_.steps[i];
      if (moves_.stroke[i] != StrokeMoves::kNoStroke) {
        step.seconds = moves_.share[i] * plan.commanded[static_cast<std::size_t>(moves_.stroke[i])];
      } else if (step.removes) {
        step.seconds = step.length() / max_feed_;
      }
      program.steps.push_back(step);
    }
    Execution execution = execute(program, machine_, progress);
    if (learnt_ == nullptr) return std::move(execution.motion);
    plan.seconds += learnt_->late;
    return late_motion(execution, late_of_steps(moves_.stroke, execution.seconds, learnt_->late));
  }

  const Part& part_;
  const LearntMotion* learnt_;  // null: nothing
  HeightMap map_;               // of the part, less what is learnt of the removal
  const RemovalKernel& kernel_;
  Machine machine_;
  ScheduleKind kind_;
  bool over_path_;
  double max_feed_;
  StrokeMoves moves_;
  KinematicPath path_;
  const std::vector<Stroke>& strokes_;
};

Index count_at_least(const Eigen::VectorXd& dwell, const Eigen::VectorXd& least) {
  Index count = 0;
  for (Index j = 0; j < dwell.size(); ++j) count += static_cast<Index>(dwell[j] <= least[j] * (1.0 + kAtLeast));
  return count;
}

/// RMS of what is left of a part as the fit counts it: weighted, of slopes where they are its objective [nm].
double counted_rms(const DwellProblem& p, const Part& part, const HeightMap& left) {
  const std::vector<Index> pixels = finite_pixels(part.map);
  Vector heights(static_cast<Index>(pixels.size())), r;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    heights[static_cast<Index>(i)] = left.values[static_cast<std::size_t>(pixels[i])];
  if (p.rows) {
    p.rows->apply(heights, r);
  } else {
    r = heights;
  }
  if (p.weights.size() > 0) r.array() *= p.weights.array();
  if (p.form.cols() > 0) r -= p.form * (p.form.transpose() * r).eval();
  return r.norm() / std::sqrt(static_cast<double>(p.pixels()));
}

/// Solves for the target as it is now. A total that is to be held is held by another price, since what the motion
/// removes on its own may ask for more time as well as for less.
WeightedDwell solve_again(PlanProblem& problem, const DwellOptions& options, const Weights& weights,
                          const Eigen::VectorXd& start, int round, const Progress& progress) {
  const std::string stage = fmt::format("motion, round {}", round);
  if (options.time_price.kind != GoalKind::TotalAtMost)
    return problem.solve(weights, start, options.max_seconds, stage, progress);
  DwellOptions held = options;
  held.smoothness = {weights.smoothness};
  WeightTrials trials;
  return choose_weights(problem, held, options.max_seconds, progress.of_part(stage), trials);
}

}  // namespace

MotionPlan plan_motion(PlanProblem& problem, const Part& part, const LaidPath& laid, const RemovalKernel& kernel,
                       const DwellOptions& options, const Weights& weights, const Eigen::VectorXd& dwell,
                       const Progress& progress) {
  const Loop loop(part, laid, kernel, options);
  MotionPlan best;
  best.at_least = count_at_least(dwell, least_dwell_of(laid, options.machine));
  std::vector<double> rounds;
  Eigen::VectorXd corrected = dwell;
  double time_price = weights.time_price;
  // Rounds are judged by what the fit counts; without weights and slopes that is the RMS that they state.
  const auto judged = [&](const HeightMap& left) {
    const DwellProblem& p = problem.with(weights);
    return p.weights.size() > 0 ? counted_rms(p, part, left) : loop.rms_of(left);
  };
  const double planned = judged(problem.left_by(dwell));
  double least = 0.0;  // of the best round
  int idle = 0;  // rounds one after the other that gained little; the strokes' times may swing once before they settle
  for (int round = 0;; ++round) {
    progress.report(fmt::format("motion: round {}", round));
    MotionPlan now;
    const HeightMap left = loop.execute_dwell(corrected, now, progress);
    rounds.push_back(loop.rms_of(left));
    const double before = least, here = judged(left);
    if (round == 0 || here < before) {
      now.at_least = best.at_least;
      now.best = round;
      now.time_price = time_price;
      best = std::move(now);
      least = here;
    }
    best.rounds = rounds;
    idle = round > 0 && here > (1.0 - kGainsLittle) * before ? idle + 1 : 0;
    if (round == options.rounds || idle > 1 || (idle > 0 && least <= kNearPlan * planned)) break;
    // What the dwell leaves less what its motion leaves is what the motion removes beyond it.
    HeightMap defect = problem.left_by(corrected);
    for (std::size_t i = 0; i < defect.values.size(); ++i) defect.values[i] -= left.values[i];
    problem.spare_target(defect);
    WeightedDwell found = solve_again(problem, options, weights, corrected, round + 1, progress);
    corrected = std::move(found.dwell);
    time_price = found.weights.time_price;
  }
  problem.spare_target({});
  return best;
}

}  // namespace dwell
