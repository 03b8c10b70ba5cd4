#include "solvers/auto_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solvers/bounded_lbfgs.h"
#include "solvers/projected_lbfgs.h"
#include "solvers/resolution_matched_hessian.h"
#include "solvers/smooth_dwell.h"
#include "solvers/solve_limits.h"

namespace dwell {
namespace {

constexpr double kKernelTolerance = 0.01;       // of matched_factor, for smooth dwell and where the kernel allows
constexpr double kLooseKernelTolerance = 0.03;  // for measured removal functions, whose noise is not worth pixels
// Smooth dwell pays with so many dwell points a variable.
constexpr Index kPointsPerVariable = 3;
constexpr double kFinePitch = 0.5;  // of pixels and of the lattice of smooth dwell, in sigmas: 0.8 leaves 2 to 9 % of the objective
// A round with a model is half as much work again as all before it, and at least so many products.
constexpr long kLeastProducts = 16;
constexpr double kRoundOfWork = 0.5;
constexpr double kLeadsOn = 0.1;    // a model that yields less than this share of its promise leads on no more
// Own gradient: used up if the full problem's gradient after a step is so many times the model's.
constexpr double kOwnGradient = 2.5;
constexpr double kExactFrom = 0.5;  // below this share, and the model's own gradient is to blame
// Smooth dwell is left for the points when a round lowers the objective by no more than this share.
constexpr double kSmoothEnough = 0.002;
// What a product costs besides its transforms, a variable, in the unit of transform_cost: spreading, stencils and the
// minimiser's own vectors. Measured on six scenarios: 10 to 40, and 45 to 60.
constexpr double kPointWork = 25.0;
constexpr double kSmoothWork = 60.0;

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
    const bool smooth = !done() && t_ == p_.lower && smooth_level(factor);
    if (!done()) points_levels(smooth ? fine_pixels(factor) : factor);
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

  /// Called after every product with a model.
  bool go_on() {
    summary_.coarse_pairs += product_cost_;
    work_ += product_work_;
    return ++products_ < budget_ && limits_.poll(point_.value);
  }

  /// The cost of a product, by its transforms alone and with all else.
  void set_product_cost(double transforms, double other) {
    product_cost_ = transforms;
    product_work_ = transforms + other / transform_cost(p_.geometry->map, p_.geometry->kernel);
  }

  void minimise(BoundedLbfgs& lbfgs, QuadraticForm& hessian, QuadraticPoint& model) {
    products_ = 0;
    budget_ = std::max(kLeastProducts, std::lround(kRoundOfWork * work_ / product_work_));
    lbfgs.minimise(hessian, 0.1 * o_.gradient_tolerance * scale_, model, monitor_);
  }

  CoarseFactor fine_pixels(CoarseFactor matched) const {
    const double finest = kFinePitch * equivalent_sigma(p_.geometry->kernel);
    const auto part = static_cast<Index>(std::ceil(static_cast<double>(std::max(matched.x, matched.y)) / finest));
    return {std::max<Index>(1, matched.x / part), std::max<Index>(1, matched.y / part)};
  }

  bool smooth_level(CoarseFactor matched) {
    const CoarseFactor factor = fine_pixels(matched);
    if (std::min(factor.x, factor.y) < 2) return false;
    SmoothDwell dwell(*p_.geometry, factor);
    if (dwell.size() * kPointsPerVariable > p_.points()) return false;
    SmoothDwellHessian hessian(p_, dwell, factor);
    set_product_cost(hessian.relative_cost(), kSmoothWork * static_cast<double>(dwell.size()));
    const Vector lower = Vector::Zero(dwell.size()), upper = dwell.largest(p_);
    BoundedLbfgs lbfgs(lower, upper, p_.geometry->threads);
    QuadraticPoint at, model;
    at.x = lower;
    Vector step;
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
      if (getenv("DWELL_DEBUG")) fmt::print(stderr, "smooth {} products {} promised {:.4g} gained {:.4g} value {:.9g} work {:.1f} coarse {:.1f} sec {:.2f}\n", factor.x, products_, before - model.value, gained, point_.value, work_, summary_.coarse_pairs, limits_.seconds());
    }
    return true;
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
    work_ += 1.0;
    limits_.count_iteration(point_.x, point_.value);
    return a;
  }

  /// The dwell points themselves, on pixels made finer each time the model no longer leads on.
  void points_levels(CoarseFactor factor) {
    BoundedLbfgs lbfgs(p_.lower, p_.upper, p_.geometry->threads);
    for (bool exact = false; !done() && std::min(factor.x, factor.y) >= 2; factor = {factor.x / 2, factor.y / 2})
      exact = points_level(lbfgs, factor, exact);
  }

  /// Returns when stopped, or when the model's promise and the full problem's gain differ too much; and then whether it
  /// had the exact gradient.
  bool points_level(BoundedLbfgs& lbfgs, CoarseFactor factor, bool exact) {
    ResolutionMatchedHessian hessian(p_, factor);
    set_product_cost(hessian.relative_cost(), kPointWork * static_cast<double>(p_.points()));
    lbfgs.forget();
    // With its own gradient a model is the better one, until what it takes for its own is no longer the removal's.
    const bool finest = static_cast<double>(std::max(factor.x, factor.y)) <= kFinePitch * equivalent_sigma(p_.geometry->kernel) || std::min(factor.x, factor.y) < 4;
    while (!done()) {
      model_.x = point_.x;
      model_.value = point_.value;
      if (exact) {
        model_.gradient = point_.gradient;
      } else {
        hessian.gradient(r_, point_.x, model_.gradient);
      }
      minimise(lbfgs, hessian, model_);
      d_ = model_.x - point_.x;
      const double promised = point_.value - model_.value, before = point_.value;
      if (promised > 0.0) move_along_d();
      if (done()) break;
      const double gained = before - point_.value;
      if (getenv("DWELL_DEBUG")) fmt::print(stderr, "points {} exact {} products {} promised {:.4g} gained {:.4g} value {:.9g} pg {:.3g} model pg {:.3g} work {:.1f} coarse {:.1f} sec {:.2f}\n", factor.x, exact, products_, promised, gained, point_.value, projected_gradient_norm(p_.lower, p_.upper, point_) / scale_, projected_gradient_norm(p_.lower, p_.upper, model_) / scale_, work_, summary_.coarse_pairs, limits_.seconds());
      const double left = projected_gradient_norm(p_.lower, p_.upper, point_),
                   left_by_model = projected_gradient_norm(p_.lower, p_.upper, model_);
      const bool leads = gained > (exact ? kLeadsOn : kExactFrom) * promised && (exact || left < kOwnGradient * left_by_model);
      const double little = o_.objective_tolerance * std::abs(before);
      if (gained < little && (leads || promised < little)) {
        settle(gained, factor);
      } else if (!leads && !exact && finest) {
        exact = true;
      } else if (!leads) {
        break;
      }
    }
    return exact;
  }

  void settle(double gained, CoarseFactor factor) {
    limits_.stop(
        SolverStatus::Settled,
        fmt::format("settled: objective {:.6g} fell by {:.2g} of itself with half as much work again; {} operator "
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
  BoundedLbfgs::Monitor monitor_;
  double scale_ = 1.0, product_cost_ = 0.0;

  double product_work_ = 0.0, work_ = 0.0;  // in operator pairs
  long products_ = 0, budget_ = 0;          // of the running round
};

/// Pixels that hold the removal function to kKernelTolerance; or, if noise or an edge asks for pixels much finer than a
/// Gaussian of the same energy would, to kLooseKernelTolerance.
CoarseFactor pixels_for(const RemovalKernel& kernel) {
  const CoarseFactor factor = matched_factor(kernel, kKernelTolerance);
  const double gaussian = 0.8 * equivalent_sigma(kernel);
  if (static_cast<double>(std::min(factor.x, factor.y)) > 0.6 * gaussian) return factor;
  return matched_factor(kernel, kLooseKernelTolerance);
}

}  // namespace

void AutoSolver::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  std::string why = "no removal geometry to coarsen";
  if (problem.geometry) {
    const CoarseFactor factor = pixels_for(problem.geometry->kernel);
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
  rest.kind = SolverKind::ProjectedLbfgs;
  const long done = summary.iterations + std::lround(summary.coarse_pairs);
  rest.max_iterations = std::max<long>(0, options_.max_iterations - done);
  SolverSummary finish = ProjectedLbfgs(rest).solve(problem, t);
  summary.status = finish.status;
  summary.objective = finish.objective;
  summary.iterations += finish.iterations;
  summary.message = fmt::format("auto: {}; projected-lbfgs: {}", why, finish.message);
}

}  // namespace dwell
