#pragma once

#include <chrono>
#include <cmath>

#include "solvers/problem/box_minimiser.h"
#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// What ends a solve. Every solver and every adapter to a third-party solver asks these rules and no other, so that all
/// of them stop for the same reasons and say so in the same words:
///
///   converged       |projected gradient| <= gradient_tolerance * |A' W P z|
///   settled         half as much work again, at least settle_iterations, lowers the objective by less than
///                   objective_tolerance of itself
///   undetermined    without smoothness, price and reference: after a tenth of the most iterations, in half as much
///   work
///                   again the dwell grows by over a tenth, and the objective falls by less than a tenth of that, both
///                   as logarithms
///   limits          iterations and coarse work, seconds
///   interrupted     the progress handle says stop; asked after every iteration and, by poll(), within long ones
///   failed          an objective or a gradient that is not finite
///
/// The first rule that is met writes status and message into the summary. The rules also show the progress: the trace
/// gets the numbers, the handle a line.
class StoppingRules {
 public:
  /// The clock starts here. All three must outlive this.
  StoppingRules(const DwellProblem& problem, const SolverOptions& options, SolverSummary& summary);

  /// Where the solve starts: the scale |A' W P z| of its gradients (1 in place of zero) and its objective [nm^2].
  void start(double gradient_scale, double value);
  double gradient_scale() const { return gradient_scale_; }

  bool stopped() const { return summary_.status != SolverStatus::NotRun; }
  /// Ends the solve for a reason of the solver's own.
  void stop(SolverStatus status, std::string message);
  double seconds() const;

  /// Counts an iteration, shows it and asks for an interrupt. value [nm^2] is the objective at dwell t.
  void count(const Vector& t, double value);
  /// False, and stopped, if work or time is used up or the objective is not finite.
  bool allow(double value);
  /// count(), then allow().
  bool count_iteration(const Vector& t, double value);
  /// Within a long iteration: allow() and, every quarter of a second, progress and interrupt.
  bool poll(double value);
  /// True, and stopped, if the projected gradient is within its tolerance; also if it is not finite.
  bool converged(double projected_gradient);
  /// True, and stopped, if the objective has settled. Asked once an iteration, with its value [nm^2];
  /// projected_gradient is a function, as it is needed for the message only.
  template <class ProjectedGradient>
  bool settled(double value, const ProjectedGradient& projected_gradient) {
    if (stopped() || !cycle_is_over()) return false;
    if (value >= checkpoint_ - options_.objective_tolerance * std::abs(checkpoint_)) {
      settle(value, projected_gradient());
      return true;
    }
    if (undetermined(checkpoint_, value, checkpoint_total_, total_)) return true;
    set_checkpoint(value);
    return false;
  }
  /// True, and stopped, if the problem has no weights and, from `before` to `value` [nm^2], the objective fell too
  /// little for the dwell that it took, from `total_before` to `total` [s]. For solvers with rounds of their own.
  bool undetermined(double before, double value, double total_before, double total);
  /// Stopped: nothing that the solver can do lowers the objective any more.
  void stop_at_rest(double value, double projected_gradient);

 private:
  bool cycle_is_over() const;
  void set_checkpoint(double value);
  void settle(double value, double projected_gradient);
  void show(double value);

  const DwellProblem& problem_;
  const SolverOptions& options_;
  SolverSummary& summary_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double shown_seconds_ = 0.0, residual_rms_ = 0.0;
  double gradient_scale_ = 1.0;
  // The objective is compared at iterations a cycle apart.
  double checkpoint_ = 0.0;
  double checkpoint_total_ = 0.0, total_ = 0.0;  // of the dwell [s], kept of problems without weights alone
  bool weightless_ = false;
  long checkpoint_iteration_ = 0;
};

/// The line shown of a solve: "iteration 12, residual 3.4 nm RMS, 0.5 s"; before the first there is no residual yet.
std::string progress_line(const SolverProgress& progress);

}  // namespace dwell
