#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/form/map_statistics.h"
#include "core/removal/exact_residual.h"
#include "runs/plan/dwell_options.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/lattice_choice.h"
#include "runs/plan/left_out.h"
#include "runs/plan/motion_plan.h"
#include "runs/plan/part.h"
#include "runs/plan/weight_trials.h"
#include "solvers/problem/certificate.h"
#include "solvers/problem/dwell_solver.h"
#include "solvers/weights/time_worth.h"

namespace dwell {

/// How long the tool dwells at every point of a laid path, and how good that answer is. Third of the four values of a
/// plan.
struct DwellPlan {
  Weights weights;                     // given, or found
  std::optional<TimePrice> worth;      // how the time price was found, where it is Auto
  double worth_smoothness = 0.0;       // with which it was found; the plan's own may be another, if that is searched
  std::optional<WeightTrials> search;  // nothing = no weight is searched over plans
  Vector seconds;                      // of every dwell point, in path order
  double step_rms = 0.0;               // |D t| / sqrt(number of links) [s]
  double seconds_before_solve = 0.0;   // wall clock of the phases before, as far as the time limit counts them [s]
  SolverSummary solver;
  Certificate certificate;
  LatticeChoice lattice;             // of the removal operator
  int lattices = 1;                  // that were solved on, each finer than the one before
  MapStatistics residual;            // as the solver predicts on its lattice, form terms removed
  ExactResidual exact;               // from the removal function itself, by the check that was asked for
  std::optional<MotionPlan> motion;  // what the machine makes of it, where there is one
  std::optional<LeftOut> left_out;   // of the fit, where blemishes are to be
  std::vector<std::string> limits;   // that were reached, one sentence each

  /// The dwell as it is run [s]: what the machine takes for the strokes after the rounds of correction, or the sum of
  /// `seconds` without one.
  double run_dwell() const { return motion ? motion->seconds.sum() : seconds.sum(); }
};

/// Solves the dwell problem of a part and a path laid on it, on a lattice that holds the removal function; where the
/// lattice's own error comes to more than 5 % of what is left, once or twice more on a finer one. Throws OutOfMemory
/// before the work if the machine has less memory than it takes for certain, TimeLimitReached if options.max_seconds
/// are over before the first solve, InputError for options that contradict each other (weights_are_searched),
/// Interrupted, std::runtime_error if the solver fails. Cost: the solver's operator applications dominate
/// (docs/math.md). `check`: how well the exact residual is to be known; for the choice of the lattice the least does,
/// and what a plan states is predicted from its program (program_prediction.h). `start`: dwell times to begin with,
/// which `auto` takes no notice of (PlanProblem::solve says why); empty = the least.
DwellPlan find_dwell(const Part& part, const LaidPath& laid, const DwellOptions& options, const Progress& progress = {},
                     ExactCheck check = ExactCheck::Lattice, Vector start = {});

}  // namespace dwell
