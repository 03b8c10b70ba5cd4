#pragma once

#include "runs/plan/plan_problem.h"

namespace dwell {

/// Solves a problem of an expected residual whose expected square is not to be above that of a dwell which is known, as
/// that of the same problem without changes. With the same weights it may be: what the rows of the changes hold back
/// costs less smoothness and time, and the optimum of all together may spend more of the residual on that. Then both
/// weights are lowered by a quarter, up to six times; less weight on them leaves less. A limit says so if that is not
/// enough. Throws as PlanProblem::solve. Cost: one to seven solves.
WeightedDwell solve_expected(PlanProblem& problem, Weights weights, const Vector& known, double max_seconds,
                             std::vector<std::string>& limits, const Progress& progress);

}  // namespace dwell
