#pragma once

#include "core/base/progress.h"
#include "solvers/problem/dwell_problem.h"
#include "solvers/weights/time_worth.h"

namespace dwell {

/// Finds the smallest price that is its own worth, price = worth_of_time(plan with that price): the longest run that
/// still pays. Begins with a price at which time hardly counts (a millionth of that from which on the least dwell is
/// optimal) and goes up; each step of this is monotone. The plans are those of a model (make_dwell_model), which takes
/// its residual from the full problem three to seven times; what it then says of the residual is right to its square,
/// as the model has to predict only changes. The problem's own price does not matter and is the found one times its
/// pixels afterwards. Deterministic, the same for any solver that is to follow. Throws Interrupted if `progress` says
/// stop, std::runtime_error if a value is not finite.
TimePrice find_time_price(DwellProblem& problem, const TimeWorth& worth, const Progress& progress);

}  // namespace dwell
