#include "runs/campaigns/pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/value_range.h"
#include "runs/job/program_style.h"
#include "runs/plan/lattice_choice.h"
#include "runs/plan/plan_problem.h"
#include "runs/plan/program_prediction.h"
#include "runs/reports/plan_blocks.h"

namespace dwell {
namespace {

constexpr std::size_t kMostWeights = 1000;

std::vector<double> logarithmic(double from, double to, std::size_t count) {
  std::vector<double> values{from};
  for (std::size_t k = 1; k + 1 < count; ++k)
    values.push_back(from * std::pow(to / from, static_cast<double>(k) / static_cast<double>(count - 1)));
  values.push_back(to);
  return values;
}

/// The weights that the text names, in any order; none if it is not a list of weights.
std::vector<double> weights_in(const std::string& text) {
  constexpr ValueRange kWeights{1e-15, 1e15, ""};  // or 0
  const std::vector<std::string_view> range = split(text, ':');
  if (range.size() == 3) {
    const auto from = finite_number(range[0]), to = finite_number(range[1]), count = finite_number(range[2]);
    const bool usable = from && to && count && kWeights.holds(*from) && kWeights.holds(*to) && *count >= 2.0 &&
                        *count <= static_cast<double>(kMostWeights) && *count == std::floor(*count);
    return usable ? logarithmic(*from, *to, static_cast<std::size_t>(*count)) : std::vector<double>();
  }
  std::vector<double> values;
  for (const std::string_view word : split(text, ',')) {
    const auto value = finite_number(word);
    if (!value || (*value != 0.0 && !kWeights.holds(*value))) return {};
    values.push_back(*value);
  }
  return values;
}

ParetoRanges complete_ranges(ParetoRanges ranges, double highest_price) {
  if (ranges.smoothnesses.empty()) ranges.smoothnesses = logarithmic(1e-3, 10.0, 5);
  if (ranges.time_prices.empty()) {
    ranges.time_prices = logarithmic(1e-5 * highest_price, 1e-2 * highest_price, 4);
    ranges.time_prices.insert(ranges.time_prices.begin(), 0.0);
  }
  return ranges;
}

/// What is to be small.
std::array<double, 3> costs(const ParetoPoint& p) { return {p.exact_rms, p.trade_off.total, p.trade_off.step_rms}; }

/// At least as good in everything, and better in something.
bool dominates(const ParetoPoint& a, const ParetoPoint& b) {
  const std::array<double, 3> x = costs(a), y = costs(b);
  return x != y && std::equal(x.begin(), x.end(), y.begin(), std::less_equal<>());
}

void report_unconverged(ParetoSweep& sweep) {
  const auto unconverged = [](const ParetoPoint& p) { return !p.solver.converged(); };
  const auto first = std::find_if(sweep.points.begin(), sweep.points.end(), unconverged);
  if (first == sweep.points.end()) return;
  sweep.limits.push_back(fmt::format(
      "{} of {} solves did not converge; the first, with smoothness {:.4g} and time price {:.4g} nm^2/s: {}: {}",
      std::count_if(sweep.points.begin(), sweep.points.end(), unconverged), sweep.points.size(),
      first->weights.smoothness, first->weights.time_price, to_string(first->solver.status), first->solver.message));
}

void report_coarse_lattices(ParetoSweep& sweep) {
  const auto too_coarse = std::count_if(sweep.points.begin(), sweep.points.end(),
                                        [](const ParetoPoint& p) { return p.lattice_too_coarse; });
  if (too_coarse == 0) return;
  sweep.limits.push_back(fmt::format(
      "{} of {} solves leave so little that the error of the lattice that they were solved on is more than {:.0f} % "
      "of it: dwell plan with their weights refines the lattice and leaves less",
      too_coarse, sweep.points.size(), 100.0 * kWorstLatticeError));
}

/// The solves of a job's dwell problem.
struct PairSolver {
  const Part& part;
  const LaidPath& laid;
  PlanProblem& problem;
  const DwellOptions& options;

  /// Solves at the weights of the point and fills the rest.
  void solve(ParetoPoint& point, const std::string& stage, const Progress& progress) const {
    WeightedDwell found = problem.solve(point.weights, {}, options.max_seconds, stage, progress);
    const ExactResidual exact =
        predict_dwell(part, laid, found.dwell, problem.left_by(found.dwell), options.machine.feed_limits().max_feed,
                      ExactCheck::Figure, progress.of_part(stage).of_part("exact residual"));
    point.trade_off = found.trade_off;
    point.exact_rms = exact.statistics.rms_about_zero();
    point.standard_error = exact.standard_error;
    point.objective = found.solver.objective;
    point.solver = std::move(found.solver);
    ++point.solver.operator_applications;
    point.lattice_too_coarse = lattice_too_coarse(exact, part.before);
    progress.report(fmt::format("{}: residual {:.4g} nm RMS, dwell {:.5g} s, step {:.4g} s RMS", stage, point.exact_rms,
                                point.trade_off.total, point.trade_off.step_rms));
  }
};

/// The points of all pairs, not solved.
std::vector<ParetoPoint> pairs_of(const ParetoRanges& ranges) {
  std::vector<ParetoPoint> points;
  for (const double smoothness : ranges.smoothnesses) {
    for (const double price : ranges.time_prices) points.emplace_back().weights = {smoothness, price};
  }
  return points;
}

}  // namespace

std::vector<double> parse_weight_list(const std::string& text, const std::string& option) {
  std::vector<double> values = weights_in(text);
  if (values.empty() || values.size() > kMostWeights) {
    throw InputError(
        fmt::format("{}: '{}'; required FROM:TO:COUNT (numbers > 0, COUNT from 2 to {}; equal ratios) or a "
                    "list of at most {} >= 0 like 0,0.01,0.1",
                    option, text, kMostWeights, counted(kMostWeights, "number")));
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

void mark_front(std::vector<ParetoPoint>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // In lexicographic order a point can only be dominated by one before it, and so by one of the front before it.
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::make_pair(costs(points[a]), a) < std::make_pair(costs(points[b]), b);
  });
  std::vector<std::size_t> front;
  for (const std::size_t k : order) {
    const bool dominated =
        std::any_of(front.begin(), front.end(), [&](std::size_t f) { return dominates(points[f], points[k]); });
    points[k].on_front = !dominated;
    if (!dominated) front.push_back(k);
  }
}

double ParetoSweep::seconds() const {
  double sum = 0.0;
  for (const ParetoPoint& p : points) sum += p.solver.seconds;
  return sum;
}

ParetoSweep solve_pairs(const JobOptions& options, const ParetoRanges& ranges, const Shard& shard,
                        const Progress& progress) {
  const DwellOptions how = dwell_options(options);
  const TimeLimit limit = time_limit(options.max_solve_s);
  Job job =
      limit.run(progress, [&](const Progress& limited) { return load_job(without_program_style(options), limited); });
  const LaidPath laid = lay_job_path(job, limit.used(), progress).laid;
  if (auto file = path_input(options)) job.inputs.push_back(std::move(*file));
  ParetoSweep sweep;
  sweep.sheet = sweep_sheet(job, {"smoothness", "time_price_nm2_per_s", "time_worth", "certify", "accept", "gcode",
                                  "machine", "schedule", "rounds", "export", "template", "log", "log_plan",
                                  "log_columns", "log_period_s", "log_tolerance_mm", "uncertainty", "robust_plan"});
  sweep.path = plan_path_block(laid);
  sweep.travel = travel_times(laid, options.lift_height_mm, how.machine);
  const auto problem = limit.run(progress, [&](const Progress& limited) {
    limited.step("setting up the removal operator");
    const LatticeChoice lattice = choose_lattice(*job.part, laid.strokes, limited.of_part("lattice"));
    return std::make_unique<PlanProblem>(*job.part, laid, lattice.kernel, how, limited);
  });
  sweep.ranges = complete_ranges(ranges, problem->highest_price());
  sweep.points = pairs_of(sweep.ranges);
  const PairSolver solver{*job.part, laid, *problem, how};
  for (const std::size_t task : shard.tasks_of(sweep.points.size())) {
    ParetoPoint& point = sweep.points[task - 1];
    const std::string stage = fmt::format("solve {} of {}: smoothness {:.4g}, time price {:.4g} nm^2/s", task,
                                          sweep.points.size(), point.weights.smoothness, point.weights.time_price);
    solver.solve(point, stage, progress);
  }
  return sweep;
}

void conclude(ParetoSweep& sweep) {
  mark_front(sweep.points);
  report_coarse_lattices(sweep);
  report_unconverged(sweep);
}

ParetoSweep sweep_weights(const JobOptions& options, const ParetoRanges& ranges, const Progress& progress) {
  ParetoSweep sweep = solve_pairs(options, ranges, {}, progress);
  conclude(sweep);
  return sweep;
}

}  // namespace dwell
