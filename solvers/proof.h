#pragma once

#include "solvers/problem/certificate.h"
#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Goes on solving from t, a solver's answer, until its objective is proven to be above the optimum's by no more than
/// the share `gap` of it: each time from the last answer, with tolerances ten times as strict. `summary` and
/// `certificate` are those of t before and after; work and seconds are summed up. Ends without a proof where a solve
/// ends for another reason than its tolerances, or the tolerances can be no stricter: summary.message says so and
/// certificate.gap() is what was reached. `options` are those of the first solve, with what is left of its limits.
/// Throws std::invalid_argument for a gap that is not > 0. Cost: the solves, and four operator applications for each.
void prove_optimum(const DwellProblem& problem, SolverOptions options, double gap, Vector& t, SolverSummary& summary,
                   Certificate& certificate);

}  // namespace dwell
