#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/map/height_map.h"
#include "runs/plan/dwell_options.h"
#include "runs/plan/expected_rows.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"
#include "solvers/problem/certificate.h"
#include "solvers/problem/dwell_problem.h"
#include "solvers/problem/dwell_solver.h"
#include "solvers/weights/time_worth.h"
#include "solvers/weights/weight_search.h"

namespace dwell {

/// A solve of a plan's dwell problem with some weights.
struct WeightedDwell {
  Weights weights;
  Vector dwell;  // [s]
  SolverSummary solver;
  TradeOff trade_off;
};

/// The dwell problem of a part and a path laid on it, with the weights left open: in heights or slopes as the options'
/// objective says, the pixels weighted as the part says. Its target is the fraction of the
/// error that the options ask for; what it states of a dwell is what remains on the part, the rest of the error too.
/// With `robust` the expected residual is made small, and the weights are to be numbers; what is stated is the residual
/// if all is as it is thought.
class PlanProblem {
 public:
  /// kernel: of the part's removal function, on the lattice of the removal operator. Cost: the removal operator's
  /// setup, and with halting motion one simulation.
  PlanProblem(const Part& part, const LaidPath& laid, const RemovalKernel& kernel, const DwellOptions& options,
              const Progress& progress = {});

  /// Solves from `start` (empty = lower bound; `auto` always starts there) for at most `max_seconds`; `stage` begins
  /// the lines of progress. Throws Interrupted if `progress` says stop, std::runtime_error if the solver fails. Cost:
  /// the solve and one operator application.
  ///
  /// Why `auto` takes no start: its coarse levels, which correct the long waves, work from the lower bound only.
  /// Started from the dwell of other weights, it meets its rule for settling long before the long waves have adapted.
  /// On a measured mirror the total stayed at 375 s where 402 s is the optimum, and a search for a target needed 7 to
  /// 20 solves instead of 6. From the lower bound its answer depends on the weights alone: the weights found, given as
  /// numbers, make the same plan. Of an expected residual (`robust`), whose plan is to be better than the plan that it
  /// starts from, it is tried once more from there where it is not.
  WeightedDwell solve(const Weights& weights, Vector start, double max_seconds, const std::string& stage,
                      const Progress& progress);

  /// Goes on from `found` until it is proven to be above the optimum by no more than the share `gap`, for at most
  /// `max_seconds`; `certificate` is that of `found` before and after. See prove_optimum.
  void prove(double gap, double max_seconds, WeightedDwell& found, Certificate& certificate, const Progress& progress);

  /// The price of a second [nm^2/s] from which on the least dwell is optimal if smoothness is left out: the steepest
  /// descent, there, of half the mean square residual. 1 if nothing descends. Cost: two operator applications.
  double highest_price();

  /// The time price that the rules give the problem with a smoothness. With slopes it is that of heights, times the
  /// ratio of the two objectives at the least dwell: a second has to take the same share off what there is. Slopes from
  /// pixel to pixel are mostly noise, and the rules, which see what no time removes, would make time dear. Throws as
  /// find_time_price, which states the cost. `part`: the same as before.
  TimePrice find_price(const Part& part, double smoothness, const TimeWorth& worth, const Progress& progress);

  /// The problem with the weights set.
  const DwellProblem& with(const Weights& weights);
  /// Leaves a removal [nm] to what is not the dwell's: the next solves have the target without it. An empty map: none.
  /// Each call starts from the part's own target.
  void spare_target(const HeightMap& removal);
  /// What the expected square of the residual is, of an expected residual [nm^2, summed over the pixels]. One operator
  /// application.
  double expected_square(const Vector& dwell) const;
  /// The surface that a dwell leaves of the part, form terms included [nm].
  HeightMap left_by(const Vector& dwell) const;

 private:
  SolverOptions solver_options(double max_seconds, const std::string& stage, const Progress& progress) const;
  TradeOff trade_off_of(const Vector& dwell);
  /// The share of the expected objective at a dwell that is not of changes, which hardly depend on the dwell and would
  /// loosen a tolerance that is relative to all of it. One operator application.
  double share_without_changes(const Vector& dwell, double& objective) const;
  void set_objective(const Part& part, const FitObjective& objective);
  /// What of heights of the pixels the objective sees.
  Vector rows_of(const Vector& heights) const;
  void set_target(const Vector& heights);

  Grid grid_;                  // of the map
  std::vector<Index> pixels_;  // of the map, linear indices
  double energy_;              // |b|^2 [nm^2/s^2]
  SolverKind kind_;
  FitObjective objective_;
  std::shared_ptr<const RemovalGeometry> geometry_;
  std::unique_ptr<RemovalOperator> removal_;  // of heights
  std::unique_ptr<RemovalOperator> slopes_;   // of the rows of an objective with slopes
  std::unique_ptr<ExpectedRows> expected_;    // of an expected residual; null: of the residual
  DwellProblem problem_;
  Vector target_;           // heights of the part
  Vector spared_;           // of the map, what the target leaves out on purpose [nm]; empty: nothing
  Vector spared_residual_;  // the same as the objective sees it, weighted and without the form terms
};

}  // namespace dwell
