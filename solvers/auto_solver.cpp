#include "solvers/auto_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "solvers/bounded_quadratic.h"
#include "solvers/projected_cg.h"
#include "solvers/resolution_matched_hessian.h"
#include "solvers/solve_limits.h"

namespace dwell {
namespace {

constexpr double kKernelTolerance = 0.01;       // of matched_factor, for smooth dwell and where the kernel allows
constexpr double kLooseKernelTolerance = 0.03;  // for measured removal functions, whose noise is not worth pixels
// Smooth dwell pays with so many dwell points a variable; finer levels of it only where the points are too many to do
// the work themselves.
constexpr Index kPointsPerVariable = 4;
constexpr Index kPointsPerFinerVariable = 32;
constexpr Index kLevels = 3;
constexpr std::array<long, 3> kLevelBudgets = {20, 80, 320};  // products with the models of a level
constexpr long kFirstBudget = 40;                             // and with the first of the dwell points
constexpr double kLeadsOn = 0.02;  // a model that yields less than this share of its promise leads on no more

class Run {
 public:
  Run(const DwellProblem& problem, const SolverOptions& options, Vector& t, SolverSummary& summary)
      : p_(problem), o_(options), summary_(summary), limits_(problem, options, summary), objective_(problem), t_(t) {
    monitor_ = [this](const QuadraticPoint&) { return go_on(); };
  }

  void run(CoarseFactor factor) {
    scale_ = objective_.gradient_scale();
    if (!(scale_ > 0.0)) scale_ = 1.0;
    point_.x = t_;
    objective_.residual(t_, r_);
    objective_.gradient(r_, t_, point_.gradient);
    point_.value = objective_.value(r_, t_);
    if (!done() && t_ == p_.lower) smooth_levels(factor);
    if (!done()) points_levels(factor);
    t_ = point_.x;
    summary_.objective = point_.value;
  }

  /// The models are used up but the gradient is not small enough.
  bool unfinished() const { return !limits_.stopped(); }

 private:
  bool done() {
    return limits_.stopped() || !limits_.allow(point_.value) ||
           limits_.converged(projected_gradient_norm(p_.lower, p_.upper, point_), scale_);
  }

  bool go_on() {
    summary_.coarse_pairs += product_cost_;
    ++products_;
    ++total_products_;
    return products_ < budget_ && limits_.allow(point_.value);
  }

  /// Coarsest first, on lattices each of which holds the one before.
  void smooth_levels(CoarseFactor finest) {
    const Index n = p_.points();
    Index level = 0;
    std::optional<SmoothDwell> dwell, before;
    Vector s;
    for (Index step = Index{1} << (kLevels - 1); level < kLevels && !done(); ++level, step /= 2) {
      const Index unit = Index{1} << (kLevels - 1);
      const CoarseFactor factor{finest.x / unit * step, finest.y / unit * step};
      if (std::min(factor.x, factor.y) < 2) break;
      dwell.emplace(*p_.geometry, factor);
      const Index worth = level == 0 ? kPointsPerVariable : kPointsPerFinerVariable;
      if (dwell->size() * worth > n) break;
      const Vector coarse = s;
      if (before) {
        dwell->refine(*before, coarse, s);
      } else {
        s = Vector::Zero(dwell->size());
      }
      smooth_level(*dwell, factor, s);
      before = *dwell;
    }
  }

  void smooth_level(const SmoothDwell& dwell, CoarseFactor factor, Vector& s) {
    SmoothDwellHessian hessian(p_, dwell, factor);
    const Vector lower = Vector::Zero(dwell.size()), upper = dwell.largest(p_);
    BoundedCg cg(lower, upper);
    QuadraticPoint at, model;
    at.x = s;
    if (upper.size() != 0) at.x = at.x.cwiseMin(upper);
    // Bounds differ a little from level to level: what was cut off is taken from the dwell as well.
    Vector step = at.x - s;
    if (step.squaredNorm() > 0.0) advance(dwell, step, at);
    product_cost_ = hessian.relative_cost();
    for (const long budget : kLevelBudgets) {
      if (done()) break;
      dwell.restrict_to(point_.gradient, at.gradient);
      at.value = point_.value;
      model = at;
      minimise(cg, hessian, budget, model);
      step = model.x - at.x;
      advance(dwell, step, at);
    }
    s = at.x;
  }

  void minimise(BoundedCg& cg, QuadraticForm& hessian, long budget, QuadraticPoint& model) {
    products_ = 0;
    budget_ = budget;
    cg.minimise(hessian, 0.1 * o_.gradient_tolerance * scale_, model, monitor_);
  }

  void advance(const SmoothDwell& dwell, const Vector& step, QuadraticPoint& at) {
    dwell.prolong(step, d_);
    at.x += move_along_d() * step;
  }

  /// Moves to the minimiser of the full objective along d_, at most all the way; returns how far. One operator pair.
  double move_along_d() {
    const double slope = point_.gradient.dot(d_);
    if (!(slope < 0.0)) return 0.0;
    objective_.image(d_, image_);
    const double curvature = objective_.curvature(d_, image_);
    const double a = curvature > 0.0 ? std::min(1.0, -slope / curvature) : 1.0;
    point_.x += a * d_;
    clip_to_bounds(p_, point_.x);  // rounding only
    r_ += a * image_;
    objective_.gradient(r_, point_.x, point_.gradient);
    point_.value = objective_.value(r_, point_.x);
    limits_.count_iteration(point_.x, point_.value);
    return a;
  }

  /// The dwell points themselves, on pixels made finer each time the model no longer leads on.
  void points_levels(CoarseFactor factor) {
    BoundedCg cg(p_.lower, p_.upper);
    model_ = point_;
    for (; !done() && std::min(factor.x, factor.y) >= 2; factor = {factor.x / 2, factor.y / 2})
      points_level(cg, factor);
  }

  /// Returns when stopped, or when the model's promise and the full problem's gain differ too much.
  void points_level(BoundedCg& cg, CoarseFactor factor) {
    ResolutionMatchedHessian hessian(p_, factor);
    product_cost_ = hessian.relative_cost();
    while (!done()) {
      // Each budget is all the work done before it, so that the gain of a step is the gain of doubling the work.
      const long budget = std::max(total_products_, kFirstBudget);
      model_.x = point_.x;
      model_.gradient = point_.gradient;
      model_.value = point_.value;
      minimise(cg, hessian, budget, model_);
      d_ = model_.x - point_.x;
      const double promised = point_.value - model_.value, before = point_.value;
      if (!(promised > 0.0)) return;
      move_along_d();
      if (done()) return;
      const double gained = before - point_.value;
      if (!(gained > kLeadsOn * promised)) return;
      if (gained <= o_.gap_tolerance * std::abs(point_.value)) settle(gained, factor);
    }
  }

  void settle(double gained, CoarseFactor factor) {
    limits_.stop(
        SolverStatus::Settled,
        fmt::format("settled: objective {:.6g} fell by {:.2g} of itself when the work was doubled; {} operator "
                    "pairs and {:.1f} pairs' worth on {} x {} pixels; |pg| {:.2g}",
                    point_.value, gained / std::abs(point_.value), summary_.iterations, summary_.coarse_pairs, factor.x,
                    factor.y, projected_gradient_norm(p_.lower, p_.upper, point_) / scale_));
  }

  const DwellProblem& p_;
  const SolverOptions& o_;
  SolverSummary& summary_;
  SolveLimits limits_;
  DwellObjective objective_;
  Vector& t_;
  QuadraticPoint point_;  // dwell, its gradient and objective on the full problem
  QuadraticPoint model_;  // of the dwell points
  Vector r_, d_, image_;
  BoundedCg::Monitor monitor_;
  double scale_ = 1.0, product_cost_ = 0.0;
  long products_ = 0, budget_ = 0, total_products_ = 0;
};

}  // namespace

void AutoSolver::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  std::string why = "no removal geometry to coarsen";
  if (problem.geometry) {
    CoarseFactor factor = matched_factor(problem.geometry->kernel, kKernelTolerance);
    if (std::min(factor.x, factor.y) < 8) factor = matched_factor(problem.geometry->kernel, kLooseKernelTolerance);
    if (std::min(factor.x, factor.y) < 2) {
      why = "removal function too narrow to coarsen the map";
    } else {
      Run run(problem, options_, t, summary);
      run.run(factor);
      if (!run.unfinished()) return;
      why = fmt::format("coarse models used up after {} operator pairs and {:.1f} pairs' worth", summary.iterations,
                        summary.coarse_pairs);
    }
  }
  SolverOptions rest = options_;
  rest.kind = SolverKind::ProjectedCg;
  const long done = summary.iterations + std::lround(summary.coarse_pairs);
  rest.max_iterations = std::max<long>(0, options_.max_iterations - done);
  SolverSummary finish = ProjectedCg(rest).solve(problem, t);
  summary.status = finish.status;
  summary.objective = finish.objective;
  summary.iterations += finish.iterations;
  summary.message = fmt::format("auto: {}; projected-cg: {}", why, finish.message);
}

}  // namespace dwell
