#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "core/map/height_map.h"
#include "core/motion/program.h"
#include "runs/plan/dwell_options.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"
#include "runs/plan/plan_problem.h"

namespace dwell {

/// What a machine makes of the dwell of a plan: the feeds to command, and what its motion leaves.
struct MotionPlan {
  std::optional<Program> program;  // its steps with their speeds, where the schedule says speeds; nothing: feeds
  std::vector<double> commanded;   // of every stroke: length / feed, of halts the dwell [s]
  Eigen::VectorXd seconds;         // that the machine then takes for every stroke [s]
  std::vector<double> rounds;      // what the motion leaves after each round, RMS about zero without form terms [nm]
  int best = 0;                    // the round that is taken; 0 = feeds made for the solver's dwell as it is
  double time_price = 0.0;         // of that round's solve [nm^2/s]; the plan's, unless a total is to be held
  Index at_least = 0;              // strokes whose dwell is the least that the machine can
  Index too_short = 0;             // strokes that take longer than their dwell however fast they are run

  double one_shot() const { return rounds.front(); }
  double executed() const { return rounds[static_cast<std::size_t>(best)]; }
};

/// Closes the loop between plan and motion by defect correction: feeds or speeds are made for the dwell as
/// options.schedule says, the machine's motion of them is simulated, and what its removal has over that of the dwell is
/// taken off the target of the next solve, which holds a total that is asked for by another price. `dwell` [s] and
/// `weights` are those of the solved plan; at most options.rounds such solves, fewer when two in a row gain less than
/// 0.2 %, or one near the plan. The best round by what the fit counts is taken, the
/// first included. `kernel` is that of the problem's lattice.
/// Throws Interrupted. Cost: a schedule, a simulation and a solve a round.
MotionPlan plan_motion(PlanProblem& problem, const Part& part, const LaidPath& laid, const RemovalKernel& kernel,
                       const DwellOptions& options, const Weights& weights, const Eigen::VectorXd& dwell,
                       const Progress& progress);

}  // namespace dwell
