#include "solvers/matched/auto_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/counted.h"
#include "solvers/matched/model_pixels.h"
#include "solvers/matched/resolution_matched_hessian.h"
#include "solvers/matched/smooth_dwell.h"
#include "solvers/native/bounded_lbfgs.h"
#include "solvers/native/projected_lbfgs.h"
#include "solvers/problem/lower_bound.h"
#include "solvers/problem/stopping_rules.h"

namespace dwell {
namespace {

// Finer levels of smooth dwell pay only where the points are very many.
constexpr Index kPointsPerFinerVariable = 10;
// Smooth dwell is left for finer when a round lowers the objective by no more than this share.
constexpr double kSmoothEnough = 0.003;
// A round with a model is half as much work again as all before it, and at least so many products; less where the last
// third of its products yields no more than this share of what all have promised.
constexpr double kRoundOfWork = 0.5;
constexpr long kLeastProducts = 16;
constexpr double kRoundIsOver = 0.03;
// After smooth dwell, the points' first round is at most so many products: where they are very many, all else is cheap.
constexpr long kFirstOnPoints = 48;
constexpr long kLeastBeforeSettling = 48;  // on the dwell points: a warm start is at rest before it is at its end
// What a product costs besides its transforms, a variable, in the unit of transform_cost: spreading, stencils and the
// minimiser's own vectors. Measured on six scenarios: 10 to 40, and 45 to 60.
constexpr double kPointWork = 25.0;
constexpr double kSmoothWork = 60.0;
// An objective that falls by less than its tolerance, and may by the proven bound be above the optimum by no more than
// the first share, is settled; up to the second it must fall by a tenth of the tolerance. Beyond, the work goes on.
constexpr double kUncertain = 0.3;
constexpr double kDoubtful = 1.0;
constexpr double kStricter = 0.1;
// A model leads on as long as its steps gain these shares of what they promise; with its own gradient, as long as the
// full problem's gradient after a step is no more than so many times the model's.
constexpr double kLeadsOn = 0.1;
constexpr double kLeadsOnItsOwn = 0.5;
constexpr double kOwnGradient = 2.5;

/// The options of what finishes a run that took `seconds`: the rest of its limits, and progress that goes on from
/// there. `options` must outlive them.
SolverOptions options_of_finish(const SolverOptions& options, const SolverSummary& so_far, double seconds) {
  SolverOptions rest = options;
  rest.kind = SolverKind::ProjectedLbfgs;
  rest.max_iterations =
      std::max<long>(0, options.max_iterations - so_far.iterations - std::lround(so_far.coarse_pairs));
  rest.max_seconds = std::max(1e-9, options.max_seconds - seconds);
  rest.progress.show = {};
  if (options.trace || options.progress.show) {
    rest.trace = [&options, iterations = so_far.iterations, pairs = so_far.coarse_pairs, seconds](SolverProgress p) {
      p.iterations += iterations;
      p.coarse_pairs += pairs;
      p.seconds += seconds;
      if (options.trace) options.trace(p);
      if (options.progress.show) options.progress.show(progress_line(p));
    };
  }
  return rest;
}

class Run {
 public:
  Run(const DwellProblem& problem, const SolverOptions& options, Vector& t, SolverSummary& summary)
      : p_(problem),
        o_(options),
        summary_(summary),
        rules_(problem, options, summary),
        objective_(problem),
        t_(t),
        finest_(finest_factor(problem)),
        sigma_(narrowest_sigma(problem)),
        pair_cost_(pair_cost(problem)) {
    monitor_ = [this](const QuadraticPoint& model) { return go_on(model); };
  }

  void run(CoarseFactor factor) {
    point_.x.swap(t_);  // a vector less while solving
    take_stock();
    rules_.start(objective_.gradient_scale(), point_.value);
    const CoarseFactor fine = fine_pixels(sigma_, factor);
    const bool smooth = !done() && point_.x == p_.lower && smooth_levels(fine);
    if (smooth) most_products_ = kFirstOnPoints;
    if (smooth && !done()) settle_if_proven();
    if (!done()) points_levels(smooth ? fine : factor);
    point_.x.swap(t_);
    summary_.objective = point_.value;
  }

  /// The models are used up and no rule has ended the run.
  bool unfinished() const { return !rules_.stopped(); }
  double seconds() const { return rules_.seconds(); }

 private:
  bool done() { return rules_.stopped() || rules_.converged(gradient_norm(point_)) || !rules_.allow(point_.value); }

  /// Residual, gradient and objective at point_.x, from nothing. At most one operator pair.
  void take_stock() {
    clip_to_bounds(p_, point_.x);
    point_.value = objective_.evaluate(point_.x, r_, point_.gradient);
    work_ += 1.0;
  }

  /// Called after every product with a model.
  bool go_on(const QuadraticPoint& model) {
    summary_.coarse_pairs += product_cost_;
    work_ += product_work_;
    if (++products_ >= budget_ || !rules_.poll(point_.value)) return false;
    if (products_ < next_look_) return true;
    next_look_ = products_ + products_ / 2;
    const double lately = seen_ - model.value, all = start_ - model.value;
    seen_ = model.value;
    return lately > kRoundIsOver * all;
  }

  /// The cost of a product, by its transforms alone and with all else.
  void set_product_cost(double transforms, double other) {
    product_cost_ = transforms;
    product_work_ = transforms + other / pair_cost_;
  }

  void minimise(BoundedLbfgs& lbfgs, QuadraticForm& hessian, QuadraticPoint& model) {
    products_ = 0;
    next_look_ = kLeastProducts;
    start_ = seen_ = model.value;
    budget_ = std::clamp(std::lround(kRoundOfWork * work_ / product_work_), kLeastProducts, most_products_);
    most_products_ = std::numeric_limits<long>::max();
    lbfgs.minimise(hessian, 0.1 * o_.gradient_tolerance * rules_.gradient_scale(), model, monitor_);
  }

  /// Coarsest first, on lattices each of which holds the one before. Returns whether there was any.
  bool smooth_levels(CoarseFactor factor) {
    std::optional<StackedSmoothDwell> dwell;
    Vector s;
    Index points_per_variable = kPointsPerVariable;
    for (; std::min(factor.x, factor.y) >= finest_ && !done(); factor = {factor.x / 2, factor.y / 2}) {
      StackedSmoothDwell next(p_, factor);
      if (!next.has_points_for_each(points_per_variable)) break;
      s = dwell ? next.refined(*dwell, s) : Vector::Zero(next.size());
      dwell = std::move(next);
      smooth_level(*dwell, factor, s);
      if (factor.x % 2 != 0 || factor.y % 2 != 0) break;
      points_per_variable = kPointsPerFinerVariable;
    }
    // On the edge of a node's reach, upper bounds of two levels may differ, and the dwell stand a trace above its own.
    if (dwell && p_.upper.size() != 0) take_stock();
    return dwell.has_value();
  }

  void smooth_level(StackedSmoothDwell& dwell, CoarseFactor factor, Vector& s) {
    say_level("smooth dwell", factor);
    SmoothDwellHessian hessian(p_, dwell, factor);
    set_product_cost(hessian.relative_cost(), kSmoothWork * static_cast<double>(dwell.size()));
    const Vector lower = Vector::Zero(dwell.size()), upper = dwell.largest(p_);
    BoundedLbfgs lbfgs(lower, upper, p_.threads());
    QuadraticPoint at, model;
    Vector step;
    at.x = s;
    if (upper.size() != 0) at.x = at.x.cwiseMin(upper);
    for (double gained = 1.0, before = 0.0; !done() && gained > kSmoothEnough * std::abs(before);) {
      d_.setZero(p_.points());
      add_penalty_gradient(p_, point_.x, d_);
      dwell.restrict_to(d_, step);
      hessian.removal_gradient(r_, at.gradient);
      at.gradient += step;
      at.value = before = point_.value;
      model = at;
      minimise(lbfgs, hessian, model);
      step = model.x - at.x;
      dwell.prolong(step, d_);
      at.x += move_along_d() * step;
      gained = before - point_.value;
    }
    s = at.x;
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
    objective_.advance(a, image_, r_);
    objective_.gradient(r_, point_.x, point_.gradient);
    point_.value = objective_.value(r_, point_.x);
    work_ += 1.0;
    rules_.count_iteration(point_.x, point_.value);
    return a;
  }

  /// The dwell points themselves, on pixels made finer each time the model no longer leads on.
  void points_levels(CoarseFactor factor) {
    BoundedLbfgs lbfgs(p_.lower, p_.upper, p_.threads());
    for (bool exact = false; !done() && std::min(factor.x, factor.y) >= finest_; factor = {factor.x / 2, factor.y / 2})
      exact = points_level(lbfgs, factor, exact);
  }

  /// Returns when stopped, or when the model's promise and the full problem's gain differ too much; and then whether it
  /// had the exact gradient.
  bool points_level(BoundedLbfgs& lbfgs, CoarseFactor factor, bool exact) {
    say_level("dwell points", factor);
    ResolutionMatchedHessian hessian(p_, factor);
    set_product_cost(hessian.relative_cost(), kPointWork * static_cast<double>(p_.points()));
    lbfgs.forget();
    const double pitch = static_cast<double>(std::max(factor.x, factor.y));
    const bool fine = pitch <= kFinePitch * sigma_ || std::min(factor.x, factor.y) / 2 < finest_;
    while (!done()) {
      model_.x = point_.x;
      model_.value = point_.value;
      if (exact) {
        model_.gradient = point_.gradient;
      } else {
        hessian.gradient(r_, point_.x, model_.gradient);
      }
      minimise(lbfgs, hessian, model_);
      points_products_ += products_;
      const double left_by_model = gradient_norm(model_);
      d_ -= point_.x;
      const double promised = point_.value - model_.value, before = point_.value, total = point_.x.sum();
      if (promised > 0.0) move_along_d();
      if (done()) break;
      const double gained = before - point_.value;
      const bool leads =
          exact ? gained > kLeadsOn * promised
                : gained > kLeadsOnItsOwn * promised && gradient_norm(point_) < kOwnGradient * left_by_model;
      const double little = o_.objective_tolerance * std::abs(before);
      const bool watched = points_products_ >= kLeastBeforeSettling;
      if (watched && gained < little && (leads || promised < little) && is_certain(gained / std::abs(before))) {
        settle(gained, factor);
      } else if ((watched && rules_.undetermined(before, point_.value, total, point_.x.sum())) ||
                 (!leads && (exact || !fine))) {
        break;
      } else if (!leads) {
        exact = true;
      }
    }
    return exact;
  }

  /// Setting up a model of a large map takes seconds.
  void say_level(const char* variables, CoarseFactor factor) const {
    o_.progress.report(fmt::format("setting up the model of {} on {} x {} pixels", variables, factor.x, factor.y));
  }

  double gradient_norm(const QuadraticPoint& point) const { return projected_gradient_norm(p_.lower, p_.upper, point); }

  /// How far the objective may be above the optimum at most, of the latter; infinite where the bound is rough, as it is
  /// without price or smoothness. Cost O(points).
  double proven_gap() const {
    const bool sharp = p_.gamma > 0.0 && squared_steps(p_, point_.x) > 0.0;
    const double bound = sharp ? lower_bound(p_, point_.x, point_.value, point_.gradient) : 0.0;
    return bound > 0.0 ? (point_.value - bound) / bound : std::numeric_limits<double>::infinity();
  }

  /// Where smooth dwell is all that the removal function can tell apart, nothing is left to do on the points.
  void settle_if_proven() {
    const double gap = proven_gap();
    if (!(gap <= o_.objective_tolerance)) return;
    rules_.stop(
        SolverStatus::Settled,
        fmt::format("settled: objective {:.6g} is proven to be within {:.2g} of the optimum's; {} operator pairs "
                    "and {:.1f} pairs' worth of coarse transforms; |pg| {:.2g}",
                    point_.value, gap, summary_.iterations, summary_.coarse_pairs,
                    gradient_norm(point_) / rules_.gradient_scale()));
  }

  /// Whether a round that lowered the objective by so small a share of itself may be the last, by the proven bound. How
  /// far one round falls is a matter of chance.
  bool is_certain(double gained) {
    const double gap = proven_gap();
    return !std::isfinite(gap) || gap <= kUncertain ||
           (gap <= kDoubtful && gained < kStricter * o_.objective_tolerance);
  }

  void settle(double gained, CoarseFactor factor) {
    rules_.stop(
        SolverStatus::Settled,
        fmt::format("settled: objective {:.6g} fell by {:.2g} in the last round, {} on {} x {} pixels; {} "
                    "operator pairs and {:.1f} pairs' worth of coarse transforms; |pg| {:.2g}",
                    point_.value, gained, counted(products_, "product"), factor.x, factor.y, summary_.iterations,
                    summary_.coarse_pairs, gradient_norm(point_) / rules_.gradient_scale()));
  }

  const DwellProblem& p_;
  const SolverOptions& o_;
  SolverSummary& summary_;
  StoppingRules rules_;
  DwellObjective objective_;
  Vector& t_;
  QuadraticPoint point_;  // dwell, its gradient and objective on the full problem
  QuadraticPoint model_;  // of the dwell points; its x becomes the step to take
  Vector &d_ = model_.x, r_, image_;
  BoundedLbfgs::Monitor monitor_;
  Index finest_;              // factor
  double sigma_, pair_cost_;  // of the narrowest removal function [pixels]; transform_cost of an operator pair
  double product_cost_ = 0.0;

  double product_work_ = 0.0, work_ = 0.0;  // in operator pairs
  long products_ = 0, budget_ = 0;          // of the running round
  long next_look_ = 0, most_products_ = std::numeric_limits<long>::max();
  double start_ = 0.0, seen_ = 0.0;  // value of the model at its start and at the last look
  long points_products_ = 0;         // of all rounds on the dwell points
};

}  // namespace

void AutoSolver::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  std::string why = "no removal geometry to coarsen";
  double seconds = 0.0;
  if (problem.has_geometry()) {
    const CoarseFactor factor = model_pixels(problem);
    if (std::min(factor.x, factor.y) < finest_factor(problem)) {
      why = "removal function too narrow to coarsen the map";
    } else {
      Run run(problem, options_, t, summary);
      run.run(factor);
      if (!run.unfinished()) return;
      seconds = run.seconds();
      why = fmt::format("coarse models used up after {} operator pairs and {:.1f} pairs' worth of coarse transforms",
                        summary.iterations, summary.coarse_pairs);
    }
  }
  SolverSummary finish = ProjectedLbfgs(options_of_finish(options_, summary, seconds)).solve(problem, t);
  summary.status = finish.status;
  summary.objective = finish.objective;
  summary.iterations += finish.iterations;
  summary.message = fmt::format("auto: {}; projected-lbfgs: {}", why, finish.message);
}

}  // namespace dwell
