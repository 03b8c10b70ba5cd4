#include "solvers/native/spectral_projected_gradient.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "solvers/problem/full_hessian.h"
#include "solvers/problem/solve_limits.h"

namespace dwell {
namespace {

constexpr std::size_t kMemory = 10;                   // M of the paper
constexpr double kSufficient = 1e-4;                  // gamma of the paper
constexpr double kShortest = 1e-30, kLongest = 1e30;  // of the spectral length

}  // namespace

void SpectralProjectedGradient::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  SolveLimits limits(problem, options_, summary);
  DwellObjective objective(problem);
  FullHessian hessian(objective);
  QuadraticPoint p;
  Vector r, direction, product;
  p.x = t;
  p.value = objective.evaluate(t, r, p.gradient);
  double scale = objective.gradient_scale();
  if (!(scale > 0.0)) scale = 1.0;
  std::array<double, kMemory> recent;
  recent.fill(p.value);
  std::size_t oldest = 0;
  double best = p.value, checkpoint = p.value, length = 0.0;
  long checkpoint_iteration = 0;
  while (!limits.converged(projected_gradient_norm(problem.lower, problem.upper, p), scale) && limits.allow(best)) {
    if (!(length > 0.0)) {
      hessian.product(p.gradient, product);
      const double curvature = p.gradient.dot(product);
      length = curvature > 0.0 ? p.gradient.squaredNorm() / curvature : 1.0;
    }
    direction = p.x - length * p.gradient;
    clip_to_bounds(problem, direction);
    direction -= p.x;
    const double slope = p.gradient.dot(direction);
    if (!(slope < 0.0)) {
      limits.stop(SolverStatus::Settled, fmt::format("settled: objective {:.6g} falls no more in rounding", best));
      break;
    }
    hessian.product(direction, product);
    const double curvature = direction.dot(product);
    const double highest = *std::max_element(recent.begin(), recent.end());
    const bool whole = p.value + slope + 0.5 * curvature <= highest + kSufficient * slope;
    const double a = whole || !(curvature > 0.0) ? 1.0 : std::min(1.0, -slope / curvature);
    p.x += a * direction;
    clip_to_bounds(problem, p.x);  // rounding only
    p.gradient += a * product;
    p.value += a * slope + 0.5 * a * a * curvature;
    length = curvature > 0.0 ? std::clamp(direction.squaredNorm() / curvature, kShortest, kLongest) : kLongest;
    recent[oldest] = p.value;
    oldest = (oldest + 1) % kMemory;
    if (p.value < best) {
      best = p.value;
      t = p.x;
    }
    if (!limits.count_iteration(t, best) || summary.iterations - checkpoint_iteration < options_.settle_iterations)
      continue;
    if (best >= checkpoint - options_.objective_tolerance * std::abs(checkpoint)) {
      limits.stop(SolverStatus::Settled,
                  fmt::format("settled: objective {:.6g} fell by {:.2g} of itself in {} iterations", best,
                              checkpoint > 0.0 ? (checkpoint - best) / checkpoint : 0.0,
                              summary.iterations - checkpoint_iteration));
    }
    checkpoint = best;
    checkpoint_iteration = summary.iterations;
  }
  if (summary.status == SolverStatus::Converged) t = p.x;  // where the gradient was measured
  objective.residual(t, r);
  summary.objective = objective.value(r, t);
}

}  // namespace dwell
