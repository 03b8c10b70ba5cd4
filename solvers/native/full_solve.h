#pragma once

#include "solvers/problem/box_minimiser.h"
#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Solves the dwell problem with the minimiser on its own Hessian, one operator pair a product, by the rules of
/// SolverOptions. Whenever the minimiser returns, its gradient, which it updates step by step, is computed anew.
void solve_in_full(const DwellProblem& problem, const SolverOptions& options, BoxMinimiser& minimiser, Vector& t,
                   SolverSummary& summary);

}  // namespace dwell
