#pragma once

#include "solvers/problem/dwell_problem.h"

namespace dwell {

/// A proven lower bound on the optimum of a dwell problem [nm^2], from any dwell t within the bounds, its objective and
/// the objective's gradient there.
///
/// Let r be the residual at t, a = A'P'W'r, and s = t - l the surplus, 0 <= s <= u - l. Half the square of a residual
/// is at least its tangent at theta r, for any theta: 1/2 |r(s)|^2 >= theta r'r(s) - theta^2 |r|^2 / 2. So the optimum
/// is at least
///
///   theta |r|^2 - theta^2 |r|^2 / 2 - theta a'(t - l) + gamma 1'l + min_s [ penalty(s) + (gamma 1 + theta a)'s ],
///
/// and what is left to minimise has no surface in it any more: smoothness and distance from the reference tie each
/// point to its neighbours on the path only (BoundedChain), which is solved exactly. The residual alone is held to what
/// t makes of it; the smoothness, which is slow to settle, is not. At the optimum theta = 1 gives the optimum itself,
/// and the bound is below it by a term of the second order in a's error. Every theta gives a bound, and the bound is
/// concave in it: the best of some is taken.
///
/// Without smoothness, upper bounds and reference a point's second must nowhere be worth more than its price, theta
/// (-a_j) <= gamma, which makes the bound rough; at a price of 0 mostly nothing is proven (0).
///
/// Rounding is on the safe side: what a multiplier lacks is charged at the most dwell that the optimum can have,
/// objective / gamma. Cost: O(n), no operator application.
double lower_bound(const DwellProblem& problem, const Vector& t, double objective, const Vector& gradient);

}  // namespace dwell
