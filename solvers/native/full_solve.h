#pragma once

#include "solvers/problem/box_minimiser.h"
#include "solvers/problem/dwell_solver.h"

namespace dwell {

/// Solves the dwell problem with the minimiser on its own Hessian, one operator pair a product, by the rules of
/// SolverOptions; the gradient carried along by the minimiser is computed anew whenever it returns.
void solve_in_full(const DwellProblem& problem, const SolverOptions& options, BoxMinimiser& minimiser, Vector& t,
                   SolverSummary& summary);

}  // namespace dwell
