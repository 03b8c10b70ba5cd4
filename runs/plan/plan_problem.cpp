#include "runs/plan/plan_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/base/errors.h"
#include "core/base/memory.h"
#include "core/form/form.h"
#include "core/removal/removal_geometry.h"
#include "core/removal/simulate.h"
#include "paths/feed/plan_program.h"
#include "runs/plan/counted_pixels.h"
#include "runs/plan/least_dwell_of.h"
#include "runs/plan/objective_rows.h"
#include "solvers/matched/time_price.h"
#include "solvers/proof.h"
#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

// An expected residual is found to within its tolerance times no less than this.
constexpr double kLeastShare = 0.01;

/// What any solver holds at least: of auto, 14 vectors of the dwell points, of others four; and three of the pixels.
void require_memory_to_solve(const Part& part, const LaidPath& laid, SolverKind solver) {
  const double points = static_cast<double>(laid.strokes.size()), pixels = static_cast<double>(part.map.valid_pixels());
  const double vectors = (solver == SolverKind::Auto ? 14.0 : 4.0) * points + 3.0 * pixels;
  require_memory(sizeof(double) * vectors,
                 fmt::format("the solution for {} pixels and {} dwell points", pixels, points));
}

/// What the dwell has to remove: a fraction of the map, less what the moves between halts remove on their way.
Vector target_of(const Part& part, const LaidPath& laid, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                 double max_feed, double fraction) {
  HeightMap target = part.map;
  if (fraction != 1.0) {
    for (double& z : target.values) z *= fraction;
  }
  if (laid.motion == Motion::Stop) {
    const Program moves = program_of(laid.path, std::vector<double>(laid.path.size(), 0.0), Motion::Stop, max_feed);
    target = surface_after(target, simulate(moves, part.map, kernel, part.threads));
  }
  Vector z(static_cast<Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    z[static_cast<Index>(i)] = target.values[static_cast<std::size_t>(pixels[i])];
  return z;
}

/// What the least dwell leaves of the objective's squares [nm^2]. One operator application.
double square_at_least_dwell(const DwellProblem& problem) {
  Vector residual;
  DwellObjective(problem).residual(problem.lower, residual);
  return residual.squaredNorm();
}

/// The rest of the map, which a fraction of less than one leaves on the part; empty for one.
Vector spared_of(const HeightMap& map, const std::vector<Index>& pixels, double fraction) {
  if (fraction == 1.0) return {};
  Vector spared(static_cast<Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    spared[static_cast<Index>(i)] = (1.0 - fraction) * map.values[static_cast<std::size_t>(pixels[i])];
  return spared;
}

}  // namespace

PlanProblem::PlanProblem(const Part& part, const LaidPath& laid, const RemovalKernel& kernel,
                         const DwellOptions& options, const Progress& progress)
    : grid_(part.map.grid),
      pixels_(finite_pixels(part.map)),
      energy_(part.kernel.energy),
      kind_(options.solver),
      objective_(options.objective),
      geometry_(std::make_shared<const RemovalGeometry>(
          removal_geometry(grid_, pixels_, kernel, laid.strokes, part.threads))),
      removal_(make_removal_operator(*geometry_)) {
  if (!(options.fraction > 0.0 && options.fraction <= 1.0)) {
    throw InputError("fraction", fmt::format("{}", options.fraction), "a number > 0 and at most 1");
  }
  require_memory_to_solve(part, laid, kind_);
  const FeedLimits limits = options.machine.feed_limits();
  progress.step("setting up the target");
  target_ = target_of(part, laid, pixels_, kernel, limits.max_feed, options.fraction);
  progress.step("setting up the form terms");
  set_objective(part, objective_);
  spared_ = spared_of(part.map, pixels_, options.fraction);
  if (spared_.size() > 0) {
    spared_residual_ = rows_of(spared_);
    if (problem_.weights.size() > 0) spared_residual_.array() *= problem_.weights.array();
    if (problem_.form.cols() > 0) spared_residual_ -= problem_.form * (problem_.form.transpose() * spared_residual_);
  }
  progress.step("setting up the smoothness along the path");
  problem_.parts = {{geometry_, path_smoothness(laid.path, laid.strokes, part.threads)}};
  problem_.lower = least_dwell_of(laid, options.machine);
  if (options.robust) {
    progress.step("setting up the rows of what is uncertain");
    expected_ = std::make_unique<ExpectedRows>(part, geometry_, *problem_.removal, *options.robust);
    problem_.removal = &expected_->removal();
    problem_.parts.front().changes = expected_->changes();
    problem_.beta = expected_->beta();
    set_target(target_);
  }
}

void PlanProblem::set_objective(const Part& part, const FitObjective& objective) {
  const std::vector<double> roots = weight_roots(part, pixels_);
  if (!roots.empty() && kind_ == SolverKind::Fourier) {
    throw InputError(
        "`weight` with `solver` fourier: a deconvolution counts all pixels alike; required another solver, or weights "
        "of which all above 0 are the same");
  }
  if (objective.has_slopes()) {
    ObjectiveRows slopes = objective_rows(part, pixels_, roots, objective);
    slopes_ = std::make_unique<RowsOfRemoval>(*removal_, *slopes.rows);
    problem_.removal = slopes_.get();
    problem_.rows = std::move(slopes.rows);
    problem_.weights = std::move(slopes.weights);
    problem_.form = std::move(slopes.form);
  } else {
    problem_.removal = removal_.get();
    problem_.rows.reset();
    problem_.weights = Vector::Map(roots.data(), static_cast<Index>(roots.size()));
    problem_.form = form_basis(grid_, pixels_, part.form, roots, part.threads);
  }
  set_target(target_);
}

/// Only the first block of rows has a target.
void PlanProblem::set_target(const Vector& heights) {
  const Vector rows = rows_of(heights);
  problem_.target.setZero(rows.size() * problem_.blocks());
  problem_.target.head(rows.size()) = rows;
}

Vector PlanProblem::rows_of(const Vector& heights) const {
  if (!problem_.rows) return heights;
  Vector rows;
  problem_.rows->apply(heights, rows);
  return rows;
}

const DwellProblem& PlanProblem::with(const Weights& weights) {
  problem_.alpha = weights.smoothness * energy_;
  problem_.gamma = weights.time_price * static_cast<double>(problem_.pixels());
  return problem_;
}

SolverOptions PlanProblem::solver_options(double max_seconds, const std::string& stage,
                                          const Progress& progress) const {
  SolverOptions options;
  options.kind = kind_;
  options.max_seconds = max_seconds;
  options.progress = progress.of_part(stage);
  return options;
}

/// What a dwell leaves is removed less target, and what the target spares.
TradeOff PlanProblem::trade_off_of(const Vector& dwell) {
  Vector residual;
  DwellObjective(problem_).residual(dwell, residual);
  residual.conservativeResize(residual.size() / problem_.blocks());  // as all is thought to be
  if (spared_residual_.size() > 0) residual -= spared_residual_;
  return {residual.norm() / std::sqrt(static_cast<double>(problem_.pixels())), dwell.sum(), step_rms(problem_, dwell)};
}

double PlanProblem::share_without_changes(const Vector& dwell, double& objective) const {
  DwellObjective expected(problem_);
  Vector residual;
  expected.residual(dwell, residual);
  objective = expected.value(residual, dwell);
  const Index rows = residual.size() / problem_.blocks();
  const double of_changes =
      0.5 * residual.tail(residual.size() - rows).squaredNorm() + 0.5 * problem_.beta * dwell.squaredNorm();
  return objective > 0.0 ? std::clamp(1.0 - of_changes / objective, kLeastShare, 1.0) : 1.0;
}

WeightedDwell PlanProblem::solve(const Weights& weights, Vector start, double max_seconds, const std::string& stage,
                                 const Progress& progress) {
  progress.check();
  with(weights);
  SolverOptions options = solver_options(max_seconds, stage, progress);
  Vector known;  // of an expected residual: the dwell that it is to be better than
  double of_known = 0.0;
  if (expected_ && start.size() > 0) {
    options.objective_tolerance *= share_without_changes(start, of_known);
    known = start;
  }
  if (kind_ == SolverKind::Auto) start.resize(0);  // see solve() in the header
  WeightedDwell found{weights, std::move(start), {}, {}};
  found.solver = make_solver(options)->solve(problem_, found.dwell);
  progress.check();
  if (known.size() > 0 && of_known < found.solver.objective) {
    options.max_seconds = std::max(1e-9, max_seconds - found.solver.seconds);
    SolverSummary again = make_solver(options)->solve(problem_, known);
    progress.check();
    again.iterations += found.solver.iterations;
    again.operator_applications += found.solver.operator_applications;
    again.coarse_pairs += found.solver.coarse_pairs;
    again.seconds += found.solver.seconds;
    found.dwell = std::move(known), found.solver = std::move(again);
  }
  options.max_seconds = std::max(1e-9, max_seconds - found.solver.seconds);
  doubt_settled(problem_, std::move(options), found.dwell, found.solver);
  progress.check();
  if (!found.solver.usable()) throw std::runtime_error("solver " + to_string(kind_) + ": " + found.solver.message);
  found.trade_off = trade_off_of(found.dwell);
  return found;
}

void PlanProblem::prove(double gap, double max_seconds, WeightedDwell& found, Certificate& certificate,
                        const Progress& progress) {
  with(found.weights);
  const long before = found.solver.iterations;
  prove_optimum(problem_, solver_options(max_seconds, "proof", progress), gap, found.dwell, found.solver, certificate);
  progress.check();
  if (found.solver.iterations > before) found.trade_off = trade_off_of(found.dwell);
}

TimePrice PlanProblem::find_price(const Part& part, double smoothness, const TimeWorth& worth,
                                  const Progress& progress) {
  if (!objective_.has_slopes()) {
    with({smoothness, 0.0});
    return find_time_price(problem_, worth, progress);
  }
  const double slopes = square_at_least_dwell(problem_);
  set_objective(part, {});
  const double heights = square_at_least_dwell(problem_);
  with({smoothness, 0.0});
  TimePrice price = find_time_price(problem_, worth, progress);
  set_objective(part, objective_);
  if (heights > 0.0) price.price *= slopes / heights;
  return price;
}

double PlanProblem::highest_price() {
  DwellObjective objective(with({}));
  Vector residual, gradient;
  objective.residual(problem_.lower, residual);
  objective.gradient(residual, problem_.lower, gradient);
  const double price = -gradient.minCoeff() / static_cast<double>(problem_.pixels());
  return price > 0.0 ? price : 1.0;
}

void PlanProblem::spare_target(const HeightMap& removal) {
  Vector heights = target_;
  for (std::size_t i = 0; i < pixels_.size() && !removal.values.empty(); ++i)
    heights[static_cast<Index>(i)] -= removal.values[static_cast<std::size_t>(pixels_[i])];
  set_target(heights);
}

double PlanProblem::expected_square(const Vector& dwell) const {
  Vector residual;
  DwellObjective(problem_).residual(dwell, residual);
  return residual.squaredNorm() + problem_.beta * dwell.squaredNorm();
}

HeightMap PlanProblem::left_by(const Vector& dwell) const {
  Vector removed;
  removal_->apply(dwell, removed);
  HeightMap left(grid_);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const auto k = static_cast<Index>(i);
    left.values[static_cast<std::size_t>(pixels_[i])] =
        target_[k] - removed[k] + (spared_.size() > 0 ? spared_[k] : 0.0);
  }
  return left;
}

}  // namespace dwell
