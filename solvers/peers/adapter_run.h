#pragma once

#include <string>

#include "solvers/problem/stopping_rules.h"

namespace dwell {

/// What the adapters to other people's solvers share: it evaluates the objective through the problem's operator, keeps
/// the best point seen, and asks our StoppingRules after every evaluation. The other solver's own stopping rules are
/// switched off, so that all solvers stop by the same ones.
/// An iteration of an adapter is one evaluation of objective and gradient: one operator pair.
class AdapterRun {
 public:
  AdapterRun(const DwellProblem& problem, const SolverOptions& options, const Vector& start, SolverSummary& summary);

  /// Objective at t and its gradient. t is moved into the bounds first, and onto a bound that it misses by rounding,
  /// as happens where a solver has variables of its own scale. Two applications; none, and no news, once stopped().
  double evaluate(Vector& t, Vector& gradient);
  /// The best objective so far; infinite before the first evaluation.
  double best_value() const { return best_value_; }
  /// Whether one of our own rules has been met.
  bool stopped() const { return rules_.stopped(); }
  /// Whether evaluations without gain settle the run (never if objective_tolerance is zero: truncated Newton methods
  /// evaluate for a long while without going anywhere); else the other solver judges that itself.
  void settle_by_evaluations(bool yes) { settles_ = yes; }
  /// The other solver says, with its reason, that the objective has settled.
  void settled(const std::string& reason);

  /// Hands over the best point seen. If none of our rules stopped the run, the other solver did, for `reason`: the
  /// answer counts as converged only if its projected gradient says so.
  void finish(const std::string& reason, Vector& t);

  /// Size of the dwell times that the first steepest-descent step would set, [s]; 1 if there is no descent. Solvers
  /// whose first steps have unit length want variables of size one. Three applications.
  double dwell_scale(const Vector& start);

 private:
  void move_to_bounds(Vector& t) const;

  const DwellProblem& problem_;
  const SolverOptions& options_;
  SolverSummary& summary_;
  StoppingRules rules_;
  DwellObjective objective_;
  Vector residual_, projected_, best_;
  double value_, best_value_;   // last and best objective
  double gradient_norm_ = 0.0;  // projected, at the last point
  bool settles_ = true;
};

}  // namespace dwell
