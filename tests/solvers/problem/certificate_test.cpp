#include "solvers/problem/certificate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/numbers.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

using test::kNaN;
using test::SmallProblem;

/// A = I, z = (3, 4, -1), 0 <= t <= (10, 2, 10): the optimum is (3, 2, 0) and |A'z| = sqrt(26).
SmallProblem by_hand() {
  SmallProblem small(Eigen::MatrixXd::Identity(3, 3), (Vector(3) << 3.0, 4.0, -1.0).finished());
  small.problem.upper = (Vector(3) << 10.0, 2.0, 10.0).finished();
  return small;
}

const double kScale = std::sqrt(26.0);

Vector dwell_of(double a, double b, double c) { return (Vector(3) << a, b, c).finished(); }

TEST(Certificate, IsCleanAtTheOptimum) {
  const SmallProblem small = by_hand();
  const Certificate c = certify(small.problem, dwell_of(3.0, 2.0, 0.0));
  EXPECT_DOUBLE_EQ(c.objective, 0.5 * (4.0 + 1.0));
  EXPECT_DOUBLE_EQ(c.residual_rms, std::sqrt(5.0 / 3.0));
  EXPECT_EQ(c.bound_violation, 0.0);
  EXPECT_EQ(c.projected_gradient, 0.0);
  EXPECT_EQ(c.dual_infeasibility, 0.0);
  EXPECT_EQ(c.complementarity, 0.0);
  EXPECT_TRUE(c.passes(1e-300));
  EXPECT_TRUE(c.passes(0.0));
}

TEST(Certificate, SeesAFreePointThatIsNotStationary) {
  const SmallProblem small = by_hand();
  const Certificate c = certify(small.problem, dwell_of(3.5, 2.0, 0.0));
  EXPECT_NEAR(c.projected_gradient, 0.5 / kScale, 1e-15);
  EXPECT_EQ(c.dual_infeasibility, 0.0);
  EXPECT_NEAR(c.complementarity, 0.5, 1e-15);
  EXPECT_TRUE(c.passes(0.5 / kScale + 1e-12));
  EXPECT_FALSE(c.passes(0.5 / kScale - 1e-12));
}

TEST(Certificate, SeesAPointHeldAtTheLowerBoundThatWantsIn) {
  const SmallProblem small = by_hand();
  const Certificate c = certify(small.problem, dwell_of(0.0, 2.0, 0.0));
  EXPECT_NEAR(c.dual_infeasibility, 3.0 / kScale, 1e-15);
  EXPECT_NEAR(c.projected_gradient, 3.0 / kScale, 1e-15);
  EXPECT_FALSE(c.passes(0.5));
}

TEST(Certificate, SeesAPointHeldAtTheUpperBoundThatWantsIn) {
  const SmallProblem small = by_hand();
  const Certificate c = certify(small.problem, dwell_of(10.0, 2.0, 0.0));
  EXPECT_NEAR(c.dual_infeasibility, 7.0 / kScale, 1e-15);
  EXPECT_NEAR(c.projected_gradient, 7.0 / kScale, 1e-15);
  EXPECT_NEAR(c.complementarity, 7.0, 1e-12);
}

TEST(Certificate, SeesSlackThatIsNotComplementary) {
  const SmallProblem small = by_hand();
  const Certificate c = certify(small.problem, dwell_of(3.0, 1.5, 0.25));
  EXPECT_NEAR(c.projected_gradient, std::hypot(2.5, 1.25) / kScale, 1e-15);
  EXPECT_NEAR(c.complementarity, 0.5, 1e-12);  // (4 - 1.5) cut off at 2; -1.25 cut off at 0
  EXPECT_EQ(c.dual_infeasibility, 0.0);
}

TEST(Certificate, SeesABoundViolatedOnEitherSide) {
  const SmallProblem small = by_hand();
  Certificate c = certify(small.problem, dwell_of(3.0, 2.0, -0.125));
  EXPECT_EQ(c.bound_violation, 0.125);
  EXPECT_FALSE(c.passes(1.0));
  c = certify(small.problem, dwell_of(3.0, 2.25, 0.0));
  EXPECT_EQ(c.bound_violation, 0.25);
  EXPECT_FALSE(c.passes(1.0));
}

TEST(Certificate, TakesAPointWithoutRoomAsOptimal) {
  SmallProblem small = by_hand();
  small.problem.lower[0] = small.problem.upper[0] = 1.0;
  EXPECT_TRUE(certify(small.problem, dwell_of(1.0, 2.0, 0.0)).passes(0.0));
  small.problem.lower[0] = small.problem.upper[0] = 5.0;
  EXPECT_TRUE(certify(small.problem, dwell_of(5.0, 2.0, 0.0)).passes(0.0));
}

TEST(Certificate, MeasuresTheAbsoluteGradientWithoutATarget) {
  SmallProblem small = by_hand();
  small.problem.target.setZero();
  EXPECT_NEAR(certify(small.problem, dwell_of(0.5, 0.0, 0.0)).projected_gradient, 0.5, 1e-15);
}

TEST(Certificate, CountsEveryTermOfTheObjective) {
  const SmallProblem small = test::random_problem({.points = 7}, 1);
  const auto q = small.quadratic();
  Vector t = Vector::Constant(7, 0.5);
  clip_to_bounds(small.problem, t);
  const Certificate c = certify(small.problem, t);
  Vector projected = q.gradient(t);
  for (Index j = 0; j < 7; ++j) {
    if (t[j] == small.problem.lower[j]) projected[j] = std::min(projected[j], 0.0);
    if (t[j] == small.problem.upper_at(j)) projected[j] = std::max(projected[j], 0.0);
  }
  EXPECT_NEAR(c.objective, q.value(t), 1e-12 * q.constant);
  EXPECT_NEAR(c.projected_gradient, projected.norm() / test::gradient_scale(small), 1e-11);
}

TEST(Certificate, CostsFourApplications) {
  const SmallProblem small = by_hand();
  certify(small.problem, dwell_of(1.0, 1.0, 1.0));
  EXPECT_EQ(small.removal->applications(), 4);
}

TEST(Certificate, RefusesADwellOrProblemThatIsNotFinite) {
  SmallProblem small = by_hand();
  for (double bad : {kNaN, kInfinity, -kInfinity})
    EXPECT_THROW(certify(small.problem, dwell_of(3.0, bad, 0.0)), std::invalid_argument);
  EXPECT_THROW(certify(small.problem, Vector::Zero(2)), std::invalid_argument);
  small.problem.target[1] = kNaN;
  EXPECT_THROW(certify(small.problem, dwell_of(3.0, 2.0, 0.0)), std::invalid_argument);
}

// A NaN that arises inside, in the operator, must not pass either.
TEST(Certificate, DoesNotPassOverANaNOfTheOperator) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(3, 3);
  a(1, 1) = kNaN;
  const SmallProblem small(a, dwell_of(3.0, 4.0, -1.0));
  EXPECT_FALSE(certify(small.problem, dwell_of(3.0, 4.0, 0.0)).passes(1e300));
}

TEST(Certificate, NoFieldPassesAsNaN) {
  for (double Certificate::*field :
       {&Certificate::objective, &Certificate::residual_rms, &Certificate::bound_violation,
        &Certificate::projected_gradient, &Certificate::dual_infeasibility, &Certificate::complementarity}) {
    Certificate c;
    EXPECT_TRUE(c.passes(1.0));
    c.*field = kNaN;
    EXPECT_FALSE(c.passes(1.0));
  }
  EXPECT_FALSE(Certificate().passes(kNaN));
}

}  // namespace
}  // namespace dwell
