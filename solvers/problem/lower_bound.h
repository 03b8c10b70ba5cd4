#pragma once

#include "solvers/problem/dwell_problem.h"

namespace dwell {

/// A proven lower bound on the optimum of a dwell problem [nm^2], from any dwell t within the bounds, its objective and
/// the objective's gradient there.
///
/// Write the objective as 1/2 |M s + q|^2 + gamma 1's + gamma 1'l over 0 <= s = t - l <= u - l, where the rows of M s +
/// q are the weighted residual, the differences of the surplus and the distance from the reference. For any y, half the
/// square is at least y'(M s + q) - |y|^2 / 2, so the optimum is at least
///
///   y'q - |y|^2 / 2 + gamma 1'l + sum_j min(0, (M'y)_j + gamma) (u_j - l_j).
///
/// At the optimum y = M s + q gives the optimum itself. Here y = theta (M s + q) of the given t, with the theta in
/// [0, 1] that gives most: without upper bound, theta is small enough that no second of dwell is worth more than its
/// price, -theta (M'y)_j <= gamma, and at a price of 0 mostly nothing is proven (0). M'y is the gradient without its
/// gamma, and y'q = |M s + q|^2 - s'M'(M s + q), so that no operator application is needed. The bound is below the
/// objective by a term of the second order in 1 - theta.
double lower_bound(const DwellProblem& problem, const Vector& t, double objective, const Vector& gradient);

}  // namespace dwell
