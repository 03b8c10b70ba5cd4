#include "solvers/proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solvers/solver_catalogue.h"

namespace dwell {
namespace {

constexpr double kStricter = 0.1;
// Beyond these, objective and gradient are rounding.
constexpr double kLeastObjectiveTolerance = 1e-11;
constexpr double kLeastGradientTolerance = 1e-12;

void take_up(const SolverSummary& more, SolverSummary& sum) {
  sum.status = more.status;
  sum.message = more.message;
  sum.objective = more.objective;
  sum.iterations += more.iterations;
  sum.operator_applications += more.operator_applications;
  sum.coarse_pairs += more.coarse_pairs;
  sum.seconds += more.seconds;
}

}  // namespace

void prove_optimum(const DwellProblem& problem, SolverOptions options, double gap, Vector& t, SolverSummary& summary,
                   Certificate& certificate) {
  if (!(gap > 0.0)) throw std::invalid_argument(fmt::format("prove_optimum: gap {}; required > 0", gap));
  while (summary.converged() && certificate.gap() > gap) {
    options.objective_tolerance *= kStricter;
    if (summary.status == SolverStatus::Converged) options.gradient_tolerance *= kStricter;
    if (options.objective_tolerance < kLeastObjectiveTolerance ||
        options.gradient_tolerance < kLeastGradientTolerance) {
      summary.message += fmt::format("; no stricter tolerance proves more than {:.3g}", certificate.gap());
      return;
    }
    const SolverSummary more = make_solver(options)->solve(problem, t);
    take_up(more, summary);
    if (!more.usable()) return;
    certificate = certify(problem, t);
    options.max_iterations = std::max<long>(0, options.max_iterations - more.iterations);
    options.max_seconds = std::max(1e-9, options.max_seconds - more.seconds);
  }
}

}  // namespace dwell
