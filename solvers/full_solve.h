#pragma once

#include <functional>

#include "solvers/bounded_quadratic.h"
#include "solvers/dwell_solver.h"

namespace dwell {

/// A minimiser of a quadratic form in the problem's box: (form, tolerance on |projected gradient|, point, monitor).
using BoxMinimiser = std::function<void(QuadraticForm&, double, QuadraticPoint&, const BoundedCg::Monitor&)>;

/// Solves the dwell problem with the minimiser on its own Hessian, one operator pair a product, by the rules of
/// SolverOptions; the gradient carried along by the minimiser is computed anew whenever it returns.
void solve_in_full(const DwellProblem& problem, const SolverOptions& options, const BoxMinimiser& minimise, Vector& t,
                   SolverSummary& summary);

}  // namespace dwell
