#include "solvers/native/projected_cg.h"

#include <gtest/gtest.h>

#include "solvers/problem/certificate.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

using test::random_problem;
using test::SmallProblem;

TEST(ProjectedCg, SettlesWhereTheObjectiveNoLongerChanges) {
  const SmallProblem small = random_problem({.points = 40, .terms = false}, 1);
  const auto q = small.quadratic();
  SolverOptions options;
  options.gradient_tolerance = 1e-14;
  options.objective_tolerance = 1e-3;
  options.settle_iterations = 10;
  Vector t;
  const SolverSummary summary = ProjectedCg(options).solve(small.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::Settled) << summary.message;
  EXPECT_TRUE(summary.converged());
  EXPECT_TRUE(summary.usable());
  EXPECT_GE(summary.iterations, options.settle_iterations);
  EXPECT_LE(q.value(t), 1.05 * q.value(test::minimise_by_coordinates(small)));
}

// Lower bounds below zero and a price on time take the objective below zero; a share of it is then a share of its size.
TEST(ProjectedCg, SettlesOnAnObjectiveBelowZero) {
  SmallProblem small = random_problem({.points = 40, .upper = false, .terms = false}, 2);
  small.problem.lower = Vector::Constant(40, -10.0);
  small.problem.target *= -1.0;
  small.problem.gamma = 5.0;
  SolverOptions options;
  options.gradient_tolerance = 1e-16;
  options.objective_tolerance = 1e-2;
  options.settle_iterations = 5;
  Vector t = Vector::Constant(40, 3.0);
  const SolverSummary summary = ProjectedCg(options).solve(small.problem, t);
  EXPECT_LT(summary.objective, 0.0);
  EXPECT_EQ(summary.status, SolverStatus::Settled);
  EXPECT_NE(summary.message.find("fell by"), std::string::npos) << summary.message;
}

// Stopped anywhere, the dwell is feasible and no worse than the start.
TEST(ProjectedCg, NeverLeavesADwellWorseThanItsStart) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const SmallProblem small = random_problem({.points = 30, .terms = seed % 2 == 0}, 100 + seed);
    const auto q = small.quadratic();
    for (long limit = 1; limit < 60; limit += 3) {
      SolverOptions options;
      options.gradient_tolerance = 1e-10;
      options.max_iterations = limit;
      Vector t = Vector::Constant(30, 0.4);
      clip_to_bounds(small.problem, t);
      const double start = q.value(t);
      const SolverSummary summary = ProjectedCg(options).solve(small.problem, t);
      ASSERT_LE(q.value(t), start * (1.0 + 1e-12)) << seed << " " << limit;
      ASSERT_EQ(certify(small.problem, t).bound_violation, 0.0);
      ASSERT_LE(summary.iterations, limit);
      ASSERT_NEAR(summary.objective, q.value(t), 1e-10 * (1.0 + q.constant));
    }
  }
}

// Every iteration is one operator pair; the projected searches and the start cost a little more.
TEST(ProjectedCg, TakesAboutAPairOfApplicationsAnIteration) {
  const SmallProblem small = random_problem({.points = 40}, 3);
  SolverOptions options;
  options.gradient_tolerance = 1e-8;
  options.objective_tolerance = 0.0;
  Vector t;
  const SolverSummary summary = ProjectedCg(options).solve(small.problem, t);
  EXPECT_TRUE(summary.converged()) << summary.message;
  EXPECT_GE(summary.operator_applications, 2 * summary.iterations);
  EXPECT_LE(summary.operator_applications, 4 * summary.iterations + 10);
}

}  // namespace
}  // namespace dwell
