#include "solvers/native/dense_nnls.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/numerics/dense_solve.h"
#include "solvers/problem/stopping_rules.h"

namespace dwell {
namespace {

/// minimise 1/2 t'H t + c't + constant within the bounds.
struct DenseProblem {
  Eigen::MatrixXd h;
  Vector c;
  double constant = 0.0;

  double value(const Vector& t) const { return 0.5 * t.dot(h * t) + c.dot(t) + constant; }
};

DenseProblem dense_problem(const DwellProblem& p) {
  DwellObjective objective(p);
  Eigen::MatrixXd a(p.residuals(), p.points());
  Vector unit = Vector::Zero(p.points()), column;
  for (Index j = 0; j < p.points(); ++j) {
    unit[j] = 1.0;
    objective.image(unit, column);
    a.col(j) = column;
    unit[j] = 0.0;
  }
  DenseProblem d;
  d.h = a.transpose() * a;
  for_parts(p, [&](const DwellPart& part, Index first, Index points) {
    if (p.alpha_of(part) > 0.0 && !part.smoothness.empty())
      d.h.block(first, first, points, points) += p.alpha_of(part) * part.smoothness.dense_normal();
  });
  if (p.beta > 0.0) d.h.diagonal().array() += p.beta;
  Vector r;
  objective.residual(unit, r);
  objective.gradient(r, unit, d.c);
  d.constant = objective.value(r, unit);
  return d;
}

class ActiveSet {
 public:
  ActiveSet(const DwellProblem& problem, const DenseProblem& dense, const SolverOptions& options, StoppingRules& rules,
            Vector& t)
      : p_(problem), d_(dense), rules_(rules), t_(t) {
    // The matrix is nearly always rank-deficient; a ridge far below the data's own noise keeps every block
    // factorisable.
    const double largest = dense.h.diagonal().maxCoeff();
    ridge_ = largest > 0.0 ? 1e-13 * largest : 1e-100;
    const double scale = rules.gradient_scale();
    tolerance_ =
        std::max(1e-12 * scale, 0.1 * options.gradient_tolerance * scale / std::sqrt(static_cast<double>(t.size())));
  }

  /// An iteration releases one point from its bound and sends others back to theirs.
  void run(const SolverSummary& summary) {
    begin_from_start();
    bool minimal = free_stationary();
    while (!rules_.stopped()) {
      const Index j = minimal ? most_promising() : -1;
      if (minimal && j < 0) {
        // The tolerance that is met here, point by point, is finer than the rules'.
        rules_.stop(SolverStatus::Converged,
                    fmt::format("converged after {}, {} free", counted(summary.iterations, "iteration"),
                                counted(free_.size(), "point")));
        return;
      }
      if (!rules_.allow(d_.value(t_))) return;
      if (minimal) release(j);
      minimise_over_free();
      minimal = true;
      rules_.count(t_, d_.value(t_));
    }
  }

 private:
  /// Variables strictly between their bounds start free.
  void begin_from_start() {
    const auto n = static_cast<std::size_t>(t_.size());
    at_upper_.assign(n, 0);
    free_mark_.assign(n, 0);
    tried_.assign(n, 0);
    for (Index j = 0; j < t_.size(); ++j) {
      const auto k = static_cast<std::size_t>(j);
      if (t_[j] > p_.lower[j] && t_[j] < p_.upper_at(j)) {
        free_.push_back(j);
        free_mark_[k] = 1;
      } else {
        at_upper_[k] = t_[j] > p_.lower[j];
      }
    }
  }

  /// Whether the start is already the minimiser over its free variables.
  bool free_stationary() const {
    const Vector g = d_.h * t_ + d_.c;
    return std::all_of(free_.begin(), free_.end(), [&](Index j) { return std::abs(g[j]) <= tolerance_; });
  }

  /// The bound variable whose gradient pulls inward most, or -1. A variable that has been unable to move since the last
  /// progress is skipped.
  Index most_promising() const {
    const Vector g = d_.h * t_ + d_.c;
    Index best = -1;
    double largest = tolerance_;
    for (Index j = 0; j < t_.size(); ++j) {
      const auto k = static_cast<std::size_t>(j);
      if (free_mark_[k] || tried_[k] || p_.lower[j] >= p_.upper_at(j)) continue;
      const double pull = at_upper_[k] ? g[j] : -g[j];
      if (pull > largest) {
        largest = pull;
        best = j;
      }
    }
    return best;
  }

  void release(Index j) {
    free_.push_back(j);
    free_mark_[static_cast<std::size_t>(j)] = 1;
    entering_ = j;
  }

  Vector minimiser_over_free() const {
    const auto k = static_cast<Index>(free_.size());
    Eigen::MatrixXd h(k, k);
    Vector rhs(k);
    const Vector g = d_.h * t_ + d_.c;
    for (Index a = 0; a < k; ++a) {
      for (Index b = 0; b < k; ++b)
        h(a, b) = d_.h(free_[static_cast<std::size_t>(a)], free_[static_cast<std::size_t>(b)]);
      h(a, a) += ridge_;
      rhs[a] = -g[free_[static_cast<std::size_t>(a)]];
    }
    return solve_symmetric(h, rhs);
  }

  void minimise_over_free() {
    while (!free_.empty()) {
      const Vector step = minimiser_over_free();
      double share = 1.0;
      for (std::size_t a = 0; a < free_.size(); ++a) {
        const Index j = free_[a];
        const double s = step[static_cast<Index>(a)];
        if (s < 0.0) share = std::min(share, (p_.lower[j] - t_[j]) / s);
        if (s > 0.0) share = std::min(share, (p_.upper_at(j) - t_[j]) / s);
      }
      share = std::max(share, 0.0);
      bool moved = false;
      for (std::size_t a = 0; a < free_.size(); ++a) {
        const double before = t_[free_[a]];
        t_[free_[a]] += share * step[static_cast<Index>(a)];
        moved = moved || t_[free_[a]] != before;
      }
      if (moved) std::fill(tried_.begin(), tried_.end(), char{0});
      if (share >= 1.0) return;
      hold_blocked(step);
    }
  }

  /// Sends the free variables that have met a bound (and would go on) back to it.
  void hold_blocked(const Vector& step) {
    std::vector<Index> still_free;
    for (std::size_t a = 0; a < free_.size(); ++a) {
      const Index j = free_[a];
      const double s = step[static_cast<Index>(a)];
      const double slack = 1e-14 * std::max(1.0, std::abs(t_[j]));
      const bool low = s < 0.0 && t_[j] <= p_.lower[j] + slack, high = s > 0.0 && t_[j] >= p_.upper_at(j) - slack;
      if (!low && !high) {
        still_free.push_back(j);
        continue;
      }
      t_[j] = low ? p_.lower[j] : p_.upper_at(j);
      at_upper_[static_cast<std::size_t>(j)] = high;
      free_mark_[static_cast<std::size_t>(j)] = 0;
      if (j == entering_) tried_[static_cast<std::size_t>(j)] = 1;
    }
    free_ = std::move(still_free);
  }

  const DwellProblem& p_;
  const DenseProblem& d_;
  StoppingRules& rules_;
  Vector& t_;
  std::vector<Index> free_;
  std::vector<char> free_mark_, at_upper_, tried_;
  Index entering_ = -1;
  double ridge_ = 0.0;
  double tolerance_ = 0.0;
};

}  // namespace

void DenseNnls::do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) {
  if (problem.points() > kMaxPoints || problem.points() * problem.residuals() > kMaxEntries) {
    throw InputError(
        fmt::format("solver dense-nnls: {} points x {} pixels; at most {} and {} matrix entries (use projected-cg)",
                    problem.points(), problem.residuals(), counted(kMaxPoints, "point"), kMaxEntries));
  }
  StoppingRules rules(problem, options_, summary);
  DwellObjective objective(problem);
  const DenseProblem dense = dense_problem(problem);
  rules.start(objective.gradient_scale(), dense.value(t));
  if (!dense.h.allFinite() || !dense.c.allFinite()) {
    rules.stop(SolverStatus::Failed, "failed: the operator gave a value that is not finite");
    return;
  }
  ActiveSet(problem, dense, options_, rules, t).run(summary);
  clip_to_bounds(problem, t);
  Vector r;
  objective.residual(t, r);
  summary.objective = objective.value(r, t);
}

}  // namespace dwell
