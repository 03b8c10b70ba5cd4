#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "runs/base/shard.h"
#include "runs/campaigns/sweep_sheet.h"
#include "runs/job/planned_job.h"
#include "solvers/problem/dwell_solver.h"
#include "solvers/weights/weight_search.h"

namespace dwell {

/// Weights of a sweep as a user writes them: "FROM:TO:COUNT", equally spaced in the logarithm, or a list "0,0.01,0.1".
/// At least one, at most 1000, >= 0 and finite; FROM, TO > 0 and COUNT a whole number >= 2. Returns them ascending,
/// without repeats. Throws InputError naming `option`, the text and what is accepted.
std::vector<double> parse_weight_list(const std::string& text, const std::string& option);

/// What is swept; empty = the default: smoothness 0.001:10:5, and time prices 0 and four from 1e-5 to 1e-2 of the
/// highest that has any effect (PlanProblem::highest_price).
struct ParetoRanges {
  std::vector<double> smoothnesses;
  std::vector<double> time_prices;  // [nm^2/s]
};

struct ParetoPoint {
  Weights weights;
  TradeOff trade_off;               // as the solver has it, the residual on its lattice
  double exact_rms = 0.0;           // the residual from the removal function itself, about zero [nm]
  double standard_error = 0.0;      // of exact_rms [nm]
  double objective = 0.0;           // [nm^2]
  SolverSummary solver;             // operator_applications with the one that measured the residual
  bool lattice_too_coarse = false;  // what the lattice is off by is much of what is left
  bool on_front = false;            // no other point is as good in exact residual, total and step, and better in one
};

struct ParetoSweep {
  SweepSheet sheet;             // of the job, whose own weights are not used
  nlohmann::ordered_json path;  // block of the JSON
  ParetoRanges ranges;
  std::vector<ParetoPoint> points;  // by smoothness, then by time price, ascending
  TravelTimes travel;               // of any run on this path, besides the dwell
  std::vector<std::string> limits;  // not empty = exit code 3

  /// Of all solves [s].
  double seconds() const;
};

/// Marks the points that no other dominates in (exact_rms, total, step), all to be small. Points that are equal in all
/// three are on the front together. Cost O(n^2) at worst; O(n |front|).
void mark_front(std::vector<ParetoPoint>& points);

/// Solves the dwell problem of a job at the pairs of weights that are a shard's, by their number in the sweep from 1,
/// and states the exact residual of each; of the others there are the weights alone. Every solve begins at the least
/// dwell, so that its answer does not depend on what was solved before. Throws as plan_job. options.max_solve_s bounds
/// each solve.
ParetoSweep solve_pairs(const JobOptions& options, const ParetoRanges& ranges, const Shard& shard,
                        const Progress& progress);

/// What only all points together show: marks the front and collects the limits.
void conclude(ParetoSweep& sweep);

/// solve_pairs of all and conclude.
ParetoSweep sweep_weights(const JobOptions& options, const ParetoRanges& ranges, const Progress& progress);

}  // namespace dwell
