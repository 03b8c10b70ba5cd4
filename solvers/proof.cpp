#include "solvers/proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

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

bool smoothness_weighs(const DwellProblem& problem) {
  return std::any_of(problem.parts.begin(), problem.parts.end(), [&problem](const DwellPart& part) {
    return problem.alpha_of(part) > 0.0 && part.smoothness.links() > 0;
  });
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
    const SolverStatus before = summary.status;
    const SolverSummary more = make_solver(options)->solve(problem, t);
    take_up(more, summary);
    if (!more.usable()) return;
    certificate = certify(problem, t);
    const bool at_limit = more.status == SolverStatus::IterationLimit || more.status == SolverStatus::TimeLimit;
    if (at_limit && certificate.gap() <= gap) summary.status = before;
    options.max_iterations = std::max<long>(0, options.max_iterations - more.iterations);
    options.max_seconds = std::max(1e-9, options.max_seconds - more.seconds);
  }
}

void doubt_settled(const DwellProblem& problem, SolverOptions options, Vector& t, SolverSummary& summary) {
  const bool has_bound = problem.gamma > 0.0 && smoothness_weighs(problem);
  if (!summary.converged() || !has_bound || options.kind == SolverKind::Fourier) return;
  Certificate certificate = certify(problem, t);
  options.max_iterations = std::min(options.max_iterations, kMostProofIterations);
  prove_optimum(problem, std::move(options), kSettledGap, t, summary, certificate);
  if (certificate.gap() <= kSettledGap || !summary.usable()) return;
  if (summary.converged()) summary.status = SolverStatus::Stalled;
  summary.message +=
      fmt::format("; its objective is not proven to be within {:.0f} % of the optimum's: what is proven is {:.3g} %",
                  100.0 * kSettledGap, 100.0 * certificate.gap());
}

}  // namespace dwell
