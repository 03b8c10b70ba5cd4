#include "solvers/native/spectral_projected_gradient.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solvers/problem/full_hessian.h"
#include "solvers/problem/stopping_rules.h"

namespace dwell {
namespace {

constexpr std::size_t kMemory = 10;                   // M of the paper
constexpr double kSufficient = 1e-4;                  // gamma of the paper
constexpr double kShortest = 1e-30, kLongest = 1e30;  // of the spectral length

}  // namespace

void SpectralProjectedGradient::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  StoppingRules rules(problem, options_, summary);
  DwellObjective objective(problem);
  FullHessian hessian(objective);
  QuadraticPoint p;
  Vector r, direction, product;
  p.x = t;
  p.value = objective.evaluate(t, r, p.gradient);
  rules.start(objective.gradient_scale(), p.value);
  std::array<double, kMemory> recent;
  recent.fill(p.value);
  std::size_t oldest = 0;
  double best = p.value, length = 0.0;
  const auto gradient_norm = [&] { return projected_gradient_norm(problem.lower, problem.upper, p); };
  while (!rules.converged(gradient_norm()) && rules.allow(best)) {
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
      rules.stop_at_rest(best, gradient_norm());
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
    if (rules.count_iteration(t, best)) rules.settled(best, gradient_norm);
  }
  if (summary.status == SolverStatus::Converged) t = p.x;  // where the gradient was measured
  objective.residual(t, r);
  summary.objective = objective.value(r, t);
}

}  // namespace dwell
