#include "solvers/native/dense_nnls.h"

#include <gtest/gtest.h>

#include "solvers/problem/certificate.h"
#include "tests/core/base/expect_error.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

using test::random_problem;
using test::SmallProblem;

SolverOptions exact() {
  SolverOptions options;
  options.kind = SolverKind::DenseNnls;
  options.gradient_tolerance = 1e-11;
  return options;
}

TEST(DenseNnls, IsExactToRounding) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const SmallProblem small = random_problem(
        {.points = 40, .upper = seed % 2 == 0, .terms = seed % 3 == 0, .rank_deficient = seed % 5 == 0}, 500 + seed);
    Vector t;
    const SolverSummary summary = DenseNnls(exact()).solve(small.problem, t);
    EXPECT_EQ(summary.status, SolverStatus::Converged) << summary.message;
    EXPECT_TRUE(certify(small.problem, t).passes(1e-11));
  }
}

TEST(DenseNnls, FindsTheSameDwellFromAnyStart) {
  const SmallProblem small = random_problem({.points = 25}, 600);
  Vector cold;
  DenseNnls(exact()).solve(small.problem, cold);
  for (double start : {0.1, 0.6, 100.0}) {
    Vector t = Vector::Constant(25, start);
    EXPECT_TRUE(DenseNnls(exact()).solve(small.problem, t).converged());
    EXPECT_LE((t - cold).norm(), 1e-9 * cold.norm()) << start;
  }
}

TEST(DenseNnls, RefusesMorePointsThanItCanHold) {
  const Index n = DenseNnls::kMaxPoints + 1;
  SmallProblem small(Eigen::MatrixXd::Identity(1, n), Vector::Ones(1));
  Vector t;
  test::expect_input_error([&] { DenseNnls(exact()).solve(small.problem, t); },
                           {"dense-nnls", "2001 points", "at most 2000", "projected-cg"});
}

}  // namespace
}  // namespace dwell
