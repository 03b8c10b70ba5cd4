#include "solvers/projected_cg.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace dwell {
namespace {

/// One solve: the iterate with its residual and gradient, kept consistent, and the workspace.
class Run {
 public:
  Run(const DwellProblem& problem, const SolverOptions& options, Vector& t, SolverSummary& summary)
      : p_(problem), o_(options), t_(t), summary_(summary), objective_(problem) {
    const Index n = problem.points(), m = problem.pixels();
    for (Vector* v : {&g_, &projected_, &step_, &direction_, &product_, &minus_gradient_}) v->resize(n);
    for (Vector* v : {&r_, &image_, &step_image_}) v->resize(m);
    free_.resize(static_cast<std::size_t>(n));
  }

  void run() {
    scale_ = objective_.gradient_scale();
    if (!(scale_ > 0.0)) scale_ = 1.0;
    objective_.residual(t_, r_);
    objective_.gradient(r_, t_, g_);
    value_ = objective_.value(r_, t_);
    objective_.image(g_, image_);
    const double curvature = objective_.curvature(g_, image_);
    if (curvature > 0.0) spectral_step_ = g_.squaredNorm() / curvature;
    double checkpoint = value_;
    long checkpoint_iteration = 0;
    while (!finished()) {
      const long before = summary_.iterations;
      if (!face_unchanged_) find_face();
      if (finished()) break;
      minimise_on_face();
      if (summary_.iterations == before && limits_allow()) {
        stop(SolverStatus::Settled, fmt::format("settled: no step lowers the objective {:.6g}; |pg| {:.2g}", value_,
                                                gradient_norm() / scale_));
      }
      // The slower the objective falls, the longer it is watched: a fixed number of iterations would stop ever earlier.
      const long watched = std::max(o_.settle_iterations, checkpoint_iteration / 2);
      if (summary_.iterations - checkpoint_iteration < watched) continue;
      if (value_ >= checkpoint - o_.objective_tolerance * std::abs(checkpoint)) {
        stop(SolverStatus::Settled,
             fmt::format("settled: objective {:.6g} fell by {:.2g} of itself in {} iterations; |pg| {:.2g}", value_,
                         checkpoint > 0.0 ? (checkpoint - value_) / checkpoint : 0.0,
                         summary_.iterations - checkpoint_iteration, gradient_norm() / scale_));
      }
      checkpoint = value_;
      checkpoint_iteration = summary_.iterations;
    }
    summary_.objective = value_;
  }

 private:
  double gradient_norm() {
    project_gradient(p_, t_, g_, projected_);
    return projected_.norm();
  }

  void stop(SolverStatus status, std::string message) {
    summary_.status = status;
    summary_.message = std::move(message);
  }

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

  /// Whether to stop; also asks the limits.
  bool finished() {
    if (summary_.status != SolverStatus::NotRun) return true;
    const double norm = gradient_norm();
    if (!std::isfinite(norm) || !std::isfinite(value_)) {
      stop(SolverStatus::Failed, fmt::format("failed: objective {}, |pg| {}", value_, norm));
    } else if (norm <= o_.gradient_tolerance * scale_) {
      stop(SolverStatus::Converged, fmt::format("converged: |pg| {:.3g} <= {:.3g} |A'z| after {} iterations",
                                                norm / scale_, o_.gradient_tolerance, summary_.iterations));
    } else if (!limits_allow()) {
      return true;
    }
    return summary_.status != SolverStatus::NotRun;
  }

  bool limits_allow() {
    if (summary_.status != SolverStatus::NotRun) return false;
    if (summary_.iterations >= o_.max_iterations) {
      stop(SolverStatus::IterationLimit,
           fmt::format("stopped after {} iterations, objective {:.6g}", summary_.iterations, value_));
    } else if (seconds() >= o_.max_seconds) {
      stop(SolverStatus::TimeLimit, fmt::format("stopped after {:.1f} s and {} iterations, objective {:.6g}", seconds(),
                                                summary_.iterations, value_));
    }
    return summary_.status == SolverStatus::NotRun;
  }

  void count_iteration() {
    ++summary_.iterations;
    if (!o_.progress) return;
    const SolverProgress progress{summary_.iterations, seconds(), value_,
                                  std::sqrt(r_.squaredNorm() / static_cast<double>(std::max<Index>(1, r_.size())))};
    if (!o_.progress(progress))
      stop(SolverStatus::Interrupted, fmt::format("interrupted after {} iterations", summary_.iterations));
  }

  /// Spectral projected-gradient steps (Birgin, Martinez, Raydan 2000) with the exact minimiser along the feasible
  /// segment, until the set of free variables stays the same.
  void find_face() {
    for (int k = 0; k < 3 && limits_allow(); ++k) {
      direction_ = t_ - spectral_step_ * g_;
      clip_to_bounds(p_, direction_);
      direction_ -= t_;
      const double slope = g_.dot(direction_);
      if (!(slope < 0.0)) return;
      objective_.image(direction_, image_);
      const double curvature = objective_.curvature(direction_, image_);
      const double a = curvature > 0.0 ? std::min(1.0, -slope / curvature) : 1.0;
      t_ += a * direction_;
      clip_to_bounds(p_, t_);  // rounding only
      r_ += a * image_;
      // Without curvature the objective falls in a straight line: only a bound ends that, so make for it.
      spectral_step_ = curvature > 0.0 ? direction_.squaredNorm() / curvature : 10.0 * spectral_step_;
      objective_.gradient(r_, t_, g_);
      value_ = objective_.value(r_, t_);
      count_iteration();
    }
  }

  /// Marks the variables that may move; returns how many marks changed.
  Index mark_free() {
    Index changed = 0;
    for (Index j = 0; j < t_.size(); ++j) {
      const bool held = (t_[j] <= p_.lower[j] && g_[j] >= 0.0) || (t_[j] >= p_.upper_at(j) && g_[j] <= 0.0);
      char& mark = free_[static_cast<std::size_t>(j)];
      changed += mark != static_cast<char>(!held);
      mark = !held;
    }
    return changed;
  }

  void mask(Vector& v) const {
    for (Index j = 0; j < v.size(); ++j) {
      if (!free_[static_cast<std::size_t>(j)]) v[j] = 0.0;
    }
  }

  /// Conjugate gradients over the free variables, as if there were no bounds, then the projected search.
  void minimise_on_face() {
    mark_free();
    minus_gradient_ = -g_;
    mask(minus_gradient_);
    direction_ = minus_gradient_;
    step_.setZero();
    step_image_.setZero();
    double rho = minus_gradient_.squaredNorm(), best_decrease = 0.0;
    const double target = o_.gradient_tolerance * scale_ * 0.1;
    for (long k = 0; k < cg_limit_ && rho > target * target && limits_allow(); ++k) {
      objective_.image(direction_, image_);
      const double curvature = objective_.curvature(direction_, image_);
      if (!(curvature > 0.0)) break;
      const double a = rho / curvature;
      step_ += a * direction_;
      step_image_ += a * image_;
      objective_.hessian_times(direction_, image_, product_);
      mask(product_);
      minus_gradient_ -= a * product_;
      const double next = minus_gradient_.squaredNorm();
      direction_ = minus_gradient_ + (next / rho) * direction_;
      const double decrease = 0.5 * a * rho;
      rho = next;
      best_decrease = std::max(best_decrease, decrease);
      count_iteration();
      if (decrease <= cg_share_ * best_decrease) break;
    }
    search();
  }

  /// Moves along the projected path of step_; the first stretch, up to the first bound met, always descends.
  void search() {
    double first_bound = 1.0;
    for (Index j = 0; j < t_.size(); ++j) {
      if (step_[j] < 0.0) first_bound = std::min(first_bound, (p_.lower[j] - t_[j]) / step_[j]);
      if (step_[j] > 0.0) first_bound = std::min(first_bound, (p_.upper_at(j) - t_[j]) / step_[j]);
    }
    if (first_bound >= 1.0) {
      const bool moved = !step_.isZero(0.0);  // not where the face has a gradient but no curvature
      t_ += step_;
      clip_to_bounds(p_, t_);
      r_ += step_image_;
      adopt();
      face_unchanged_ = moved && mark_free() == 0;
      cg_share_ = std::max(cg_share_ * 0.1, 1e-6);
      cg_limit_ = std::min<long>(cg_limit_ * 2, 400);
      return;
    }
    face_unchanged_ = false;
    for (double s = 1.0; s > first_bound; s *= 0.5) {
      direction_ = t_ + s * step_;
      clip_to_bounds(p_, direction_);
      direction_ -= t_;
      objective_.image(direction_, image_);
      const double slope = g_.dot(direction_), curvature = objective_.curvature(direction_, image_);
      // f(t + a d) = f + a slope + a^2/2 curvature: the best a in [0, 1] stays feasible, since the bounds are convex.
      if (!(slope < 0.0)) continue;
      const double a = curvature > 0.0 ? std::min(1.0, -slope / curvature) : 1.0;
      if (a < 0.5 && s * 0.5 > first_bound) continue;
      t_ += a * direction_;
      clip_to_bounds(p_, t_);
      r_ += a * image_;
      adopt();
      return;
    }
    t_ += std::max(0.0, first_bound) * step_;
    clip_to_bounds(p_, t_);
    r_ += std::max(0.0, first_bound) * step_image_;
    adopt();
  }

  void adopt() {
    objective_.gradient(r_, t_, g_);
    value_ = objective_.value(r_, t_);
  }

  const DwellProblem& p_;
  const SolverOptions& o_;
  Vector& t_;
  SolverSummary& summary_;
  DwellObjective objective_;
  Vector g_, projected_, step_, direction_, product_, minus_gradient_;  // n
  Vector r_, image_, step_image_;                                       // m
  std::vector<char> free_;
  double scale_ = 1.0;
  double value_ = 0.0;
  double spectral_step_ = 1.0;
  double cg_share_ = 0.05;  // CG ends when a step gains less than this share of its best step
  long cg_limit_ = 25;
  bool face_unchanged_ = false;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

void ProjectedCg::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  Run(problem, options_, t, summary).run();
}

}  // namespace dwell
