#pragma once

#include "solvers/problem/certificate.h"
#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Goes on solving from t, a solver's answer, until its objective is proven to be above the optimum's by no more than
/// the share `gap` of it: each time from the last answer, with tolerances ten times as strict. `summary` and
/// `certificate` are those of t before and after; work and seconds are summed up. A proof that a limit cut short after
/// all was proven leaves the status as it was. Ends without a proof where a solve ends for another reason than its
/// tolerances, or the tolerances can be no stricter: summary.message says so and certificate.gap() is what was reached.
/// `options` are those of the first solve, with what is left of its limits.
/// Throws std::invalid_argument for a gap that is not > 0. Cost: the solves, and four operator applications for each.
void prove_optimum(const DwellProblem& problem, SolverOptions options, double gap, Vector& t, SolverSummary& summary,
                   Certificate& certificate);

/// What a solver's own rules do not ask for is asked here: an answer that is settled or converged is one only if the
/// bound has it within twice the optimum (kSettledGap), where there is a bound (smoothness and time price above
/// 0). prove_optimum goes on from any other, for at most kMostProofIterations; where that is not enough, the status
/// becomes that limit, or Stalled, and the message says what is proven. That a solver's objective no longer falls says
/// little on an ill-conditioned problem: on one, the total dwell of four settled solvers was from 26,000 to 45,000 s,
/// and the bound between 60 times and twice the optimum. Cost: two operator applications, and the solves of
/// prove_optimum.
inline constexpr double kSettledGap = 1.0;
inline constexpr long kMostProofIterations = 2000;
void doubt_settled(const DwellProblem& problem, SolverOptions options, Vector& t, SolverSummary& summary);

}  // namespace dwell
