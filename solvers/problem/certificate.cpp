#include "solvers/problem/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/counted.h"
#include "solvers/problem/lower_bound.h"

namespace dwell {

bool Certificate::passes(double tolerance) const {
  return std::isfinite(objective) && std::isfinite(residual_rms) && std::isfinite(complementarity) &&
         bound_violation <= 0.0 && projected_gradient <= tolerance && dual_infeasibility <= tolerance;
}

double Certificate::gap() const {
  if (!(lower_bound > 0.0)) return std::numeric_limits<double>::infinity();
  return std::max(0.0, objective - lower_bound) / lower_bound;
}

Certificate certify(const DwellProblem& problem, const Vector& t) {
  validate(problem);
  if (t.size() != problem.points()) {
    throw std::invalid_argument(fmt::format("dwell has {}; the problem has {}", counted(t.size(), "value"),
                                            counted(problem.points(), "point")));
  }
  if (!t.allFinite()) throw std::invalid_argument("dwell has a value that is not finite");

  DwellObjective objective(problem);
  Vector r, g, projected, image;
  objective.residual(t, r);
  objective.gradient(r, t, g);
  project_gradient(problem, t, g, projected);
  objective.image(projected, image);

  Certificate c;
  c.objective = objective.value(r, t);
  c.residual_rms = std::sqrt(r.squaredNorm() / static_cast<double>(std::max<Index>(1, problem.pixels())));
  // With no target there is nothing to scale by: the absolute gradient is then the measure.
  const double scale = objective.gradient_scale() > 0.0 ? objective.gradient_scale() : 1.0;
  c.projected_gradient = projected.norm() / scale;
  const double norm2 = projected.squaredNorm();
  const double curvature = objective.curvature(projected, image);
  const double step = curvature > 0.0 ? norm2 / curvature : 0.0;
  for (Index j = 0; j < t.size(); ++j) {
    const double l = problem.lower[j], u = problem.upper_at(j);
    c.bound_violation = std::max({c.bound_violation, l - t[j], t[j] - u});
    if (t[j] <= l) c.dual_infeasibility = std::max(c.dual_infeasibility, t[j] >= u ? 0.0 : -g[j] / scale);
    if (t[j] >= u) c.dual_infeasibility = std::max(c.dual_infeasibility, t[j] <= l ? 0.0 : g[j] / scale);
    c.complementarity = std::max(c.complementarity, std::abs(t[j] - std::clamp(t[j] - step * g[j], l, u)));
  }
  c.lower_bound = lower_bound(problem, t, c.objective, g);
  return c;
}

}  // namespace dwell
