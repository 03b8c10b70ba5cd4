#include "solvers/problem/lower_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/base/numbers.h"
#include "solvers/problem/certificate.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

using test::minimise_by_coordinates;
using test::random_problem;
using test::SmallProblem;

double bound_at(const SmallProblem& small, const Vector& t) { return certify(small.problem, t).lower_bound; }

/// A dwell within the bounds, up to one beyond the lower one.
Vector some_dwell(const DwellProblem& p, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Vector t(p.points());
  for (Index j = 0; j < t.size(); ++j) t[j] = std::min(p.lower[j] + u(random), p.upper_at(j));
  return t;
}

TEST(LowerBound, IsNeverAboveTheOptimum) {
  for (const bool upper : {false, true}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      SmallProblem small = random_problem({.points = 12, .upper = upper}, seed);
      for (const double price : {0.0, 1e-3, 0.1, 3.0}) {
        small.problem.gamma = price;
        const test::Quadratic q = small.quadratic();
        const Vector optimum = minimise_by_coordinates(small);
        const double best = q.value(optimum), rounding = 1e-9 * q.constant;
        for (unsigned k = 0; k < 5; ++k) {
          EXPECT_LE(bound_at(small, some_dwell(small.problem, 10 * seed + k)), best + rounding) << seed << ' ' << price;
        }
        EXPECT_LE(bound_at(small, small.problem.lower), best + rounding);
        EXPECT_LE(bound_at(small, optimum), best + rounding);
      }
    }
  }
}

TEST(LowerBound, IsTheOptimumAtTheOptimumOfAPricedProblem) {
  for (const bool upper : {false, true}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      SmallProblem small = random_problem({.points = 12, .upper = upper}, seed);
      const Vector optimum = minimise_by_coordinates(small);
      const double best = small.quadratic().value(optimum);
      EXPECT_NEAR(bound_at(small, optimum), best, 1e-6 * best) << seed;
      EXPECT_LE(certify(small.problem, optimum).gap(), 1e-6) << seed;
    }
  }
}

TEST(LowerBound, ProvesNothingWithoutPriceAndBoundsWhereDwellIsStillWorthSomething) {
  // One pixel, one point: 1/2 (t - 3)^2, at t = 1 a second is worth 2.
  SmallProblem small(Eigen::MatrixXd::Identity(1, 1), Vector::Constant(1, 3.0));
  EXPECT_EQ(bound_at(small, Vector::Constant(1, 1.0)), 0.0);
  EXPECT_EQ(certify(small.problem, Vector::Constant(1, 1.0)).gap(), kInfinity);
  small.problem.gamma = 1.0;  // the optimum is t = 2: 1/2 + 2; theta = 1/2 gives 1/2 * 6 - 1/8 * 4
  EXPECT_DOUBLE_EQ(bound_at(small, Vector::Constant(1, 1.0)), 2.5);
  small.problem.gamma = 0.5;  // t = 2.5: 1/8 + 5/4; theta = 1/4: 3/2 - 1/8
  EXPECT_DOUBLE_EQ(bound_at(small, Vector::Constant(1, 1.0)), 1.375);
}

TEST(LowerBound, DoesNotSufferFromDwellThatIsRoughButRemovesTheSame) {
  // Every column twice: what one of a pair gives to the other changes the smoothness and nothing else.
  Eigen::MatrixXd matrix(30, 8);
  for (Index i = 0; i < 30; ++i)
    for (Index j = 0; j < 8; ++j) {
      const double away = static_cast<double>(i) - 7.0 * static_cast<double>(j / 2) - 3.0;
      matrix(i, j) = std::exp(-away * away / 20.0);
    }
  SmallProblem small(matrix, Vector::LinSpaced(30, 2.0, 5.0));
  small.set_smoothness(0.5, std::vector<double>(8, 1.0), {0, 1, 1, 1, 1, 1, 1, 1});
  small.problem.gamma = 0.1;
  small.problem.lower.setConstant(0.2);
  const Vector optimum = minimise_by_coordinates(small);
  const double best = small.quadratic().value(optimum);
  Vector rough = optimum;
  for (Index j = 0; j < 8; j += 2) {
    const double moved = 0.8 * (optimum[j] - 0.2);
    rough[j] -= moved;
    rough[j + 1] += moved;
  }
  EXPECT_GT(small.quadratic().value(rough), 1.2 * best);
  EXPECT_NEAR(bound_at(small, rough), best, 1e-7 * best);
  EXPECT_LE(bound_at(small, rough), best + 1e-9 * best);
}

}  // namespace
}  // namespace dwell
