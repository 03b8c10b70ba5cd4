#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "core/base/numbers.h"
#include "solvers/problem/certificate.h"
#include "solvers/solver_catalogue.h"
#include "tests/core/base/expect_error.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::kNaN;
using test::random_problem;
using test::SmallProblem;

/// Strict: converged by gradient, not by patience.
SolverOptions strict(SolverKind kind, double tolerance = 1e-8) {
  SolverOptions options;
  options.kind = kind;
  options.gradient_tolerance = tolerance;
  options.objective_tolerance = 0.0;
  options.settle_iterations = 100'000;
  options.max_iterations = 20'000;
  options.max_seconds = 60.0;
  return options;
}

/// Solves and compares with the optimum found otherwise; the certificate must agree.
void expect_solved(const SmallProblem& small, SolverKind kind, const Vector& optimum) {
  const SolverOptions options = strict(kind);
  const auto q = small.quadratic();
  Vector t;
  const SolverSummary summary = make_solver(options)->solve(small.problem, t);
  ASSERT_EQ(summary.status, SolverStatus::Converged) << summary.message;
  ASSERT_EQ(t.size(), optimum.size());
  const double slack = test::objective_slack(small, options.gradient_tolerance, t, optimum);
  EXPECT_LE(q.value(t), q.value(optimum) + slack) << summary.message;
  EXPECT_GE(q.value(t), q.value(optimum) - slack) << "the oracle is not optimal";
  EXPECT_NEAR(summary.objective, q.value(t), 1e-11 * (1.0 + q.constant));
  const Certificate certificate = certify(small.problem, t);
  EXPECT_TRUE(certificate.passes(options.gradient_tolerance))
      << certificate.projected_gradient << " " << certificate.dual_infeasibility << " " << certificate.bound_violation;
}

/// Our own solvers, and the oracle of the larger tests. adapters_test.cpp tests the other peers.
std::vector<SolverKind> native_solvers() {
  std::vector<SolverKind> kinds{SolverKind::DenseNnls};
  for (const SolverRecord& record : solver_catalogue()) {
    if (!record.peer) kinds.push_back(record.kind);
  }
  return kinds;
}

class EverySolver : public testing::TestWithParam<SolverKind> {};
INSTANTIATE_TEST_SUITE_P(Native, EverySolver, testing::ValuesIn(native_solvers()), [](const auto& kind) {
  std::string name = to_string(kind.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Oracles, AgreeWithEachOtherAndHoldBoundsOnBothSides) {
  long low = 0, high = 0, free = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SmallProblem small = random_problem({.points = 6, .terms = seed % 2 == 0}, seed);
    const auto q = small.quadratic();
    const Vector a = test::minimise_by_enumeration(small), b = test::minimise_by_coordinates(small);
    ASSERT_EQ(a.size(), 6);
    EXPECT_NEAR(q.value(a), q.value(b), 1e-12 * (1.0 + q.constant));
    for (Index j = 0; j < 6; ++j) {
      low += a[j] == small.problem.lower[j];
      high += a[j] == small.problem.upper_at(j);
      free += a[j] > small.problem.lower[j] && a[j] < small.problem.upper_at(j);
    }
  }
  EXPECT_GT(low, 10);
  EXPECT_GT(high, 10);
  EXPECT_GT(free, 10);
}

TEST_P(EverySolver, AgreesWithEnumerationOnSmallProblems) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const SmallProblem small = random_problem({.points = 1 + static_cast<Index>(seed % 6),
                                               .upper = seed % 3 != 0,
                                               .terms = seed % 2 == 0,
                                               .rank_deficient = seed % 5 == 0},
                                              seed);
    expect_solved(small, GetParam(), test::minimise_by_enumeration(small));
  }
}

TEST_P(EverySolver, AgreesWithCoordinateDescentOnLargerProblems) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const SmallProblem small = random_problem({.points = 7 + static_cast<Index>(seed % 34),
                                               .upper = seed % 3 != 0,
                                               .terms = seed % 2 == 0,
                                               .rank_deficient = seed % 5 == 0},
                                              1000 + seed);
    expect_solved(small, GetParam(), test::minimise_by_coordinates(small));
  }
}

TEST_P(EverySolver, LeavesTheLowerBoundForAZeroTarget) {
  SmallProblem small = random_problem({.points = 8, .upper = false, .terms = false}, 3);
  small.problem.target.setZero();
  Vector t = Vector::Ones(8);
  const SolverSummary summary = make_solver(strict(GetParam()))->solve(small.problem, t);
  EXPECT_TRUE(summary.converged()) << summary.message;
  EXPECT_TRUE(certify(small.problem, t).passes(1e-8));
  EXPECT_LE((t - test::minimise_by_coordinates(small)).norm(), 1e-7);
}

TEST_P(EverySolver, StaysAtTheLowerBoundWhereTheTargetIsNegativeEverywhere) {
  SmallProblem small = random_problem({.points = 12, .terms = false}, 4);
  small.problem.target = -(small.problem.target.cwiseAbs() + Vector::Ones(200));
  Vector t = Vector::Constant(12, 0.7);
  const SolverSummary summary = make_solver(strict(GetParam()))->solve(small.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::Converged) << summary.message;
  EXPECT_EQ(t, small.problem.lower);
}

TEST_P(EverySolver, SolvesOnePointAndOnePixel) {
  SmallProblem one(Eigen::MatrixXd::Constant(1, 1, 4.0), Vector::Constant(1, 10.0));
  expect_solved(one, GetParam(), Vector::Constant(1, 2.5));
  one.problem.upper = Vector::Constant(1, 2.0);
  expect_solved(one, GetParam(), Vector::Constant(1, 2.0));
  SmallProblem pixel(Eigen::MatrixXd::Constant(1, 5, 2.0), Vector::Constant(1, 10.0));
  expect_solved(pixel, GetParam(), Vector::Ones(5));
  SmallProblem point(Eigen::MatrixXd::Constant(200, 1, 2.0), Vector::LinSpaced(200, 0.0, 8.0));
  expect_solved(point, GetParam(), Vector::Constant(1, 2.0));
}

TEST_P(EverySolver, TakesBoundsThatLeaveNoRoom) {
  SmallProblem small = random_problem({.points = 6, .terms = false}, 5);
  small.problem.upper = small.problem.lower;
  expect_solved(small, GetParam(), small.problem.lower);
  small.problem.upper[2] += 0.5;
  expect_solved(small, GetParam(), test::minimise_by_enumeration(small));
}

// Dwell points that reach no pixel: only the price of time, or nothing at all, speaks about them.
TEST_P(EverySolver, SendsPointsOutOfReachToTheLowerBoundAtAPrice) {
  SmallProblem dead(Eigen::MatrixXd::Zero(3, 2), Vector::Ones(3));
  dead.problem.gamma = 0.1;
  Vector t = Vector::Constant(2, 5.0);
  SolverOptions options = strict(GetParam());
  options.max_seconds = 5.0;
  SolverSummary summary = make_solver(options)->solve(dead.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::Converged) << summary.message;
  EXPECT_EQ(t, dead.problem.lower);

  SmallProblem some = random_problem({.points = 6, .upper = false, .terms = false}, 6);
  Eigen::MatrixXd a = some.a;
  a.col(1).setZero();
  SmallProblem part(a, some.problem.target);
  part.problem.gamma = 0.1;
  t = Vector::Constant(6, 50.0);
  summary = make_solver(options)->solve(part.problem, t);
  if (GetParam() == SolverKind::SpectralProjectedGradient) {
    // Its steps have the length that suits the curved directions, far too short for a price without any curvature.
    EXPECT_TRUE(summary.usable() && !summary.converged()) << summary.message;
    EXPECT_LT(t[1], 50.0);
    return;
  }
  EXPECT_EQ(summary.status, SolverStatus::Converged) << summary.message;
  EXPECT_EQ(t[1], 0.0);
  EXPECT_TRUE(certify(part.problem, t).passes(1e-8));
}

TEST_P(EverySolver, EndsAtOnceFromTheOptimum) {
  const SmallProblem small = random_problem({.points = 20}, 7);
  Vector t;
  const SolverSummary first = make_solver(strict(GetParam(), 1e-9))->solve(small.problem, t);
  ASSERT_TRUE(first.converged()) << first.message;
  EXPECT_GT(first.iterations, 3);
  const Vector optimum = t;
  const SolverSummary again = make_solver(strict(GetParam(), 1e-7))->solve(small.problem, t);
  EXPECT_EQ(again.status, SolverStatus::Converged) << again.message;
  EXPECT_LE(again.iterations, 1);
  EXPECT_LE((t - optimum).norm(), 1e-6 * optimum.norm());
}

TEST_P(EverySolver, StopsAtTheIterationLimitWithAUsableDwell) {
  const SmallProblem small = random_problem({.points = 30}, 8);
  const auto q = small.quadratic();
  Vector start = Vector::Constant(30, 0.4);
  clip_to_bounds(small.problem, start);
  SolverOptions options = strict(GetParam(), 1e-12);
  for (long limit : {0L, 1L, 2L, 5L}) {
    options.max_iterations = limit;
    Vector t = start;
    const SolverSummary summary = make_solver(options)->solve(small.problem, t);
    EXPECT_EQ(summary.status, SolverStatus::IterationLimit) << summary.message;
    EXPECT_EQ(summary.iterations, limit);
    EXPECT_TRUE(summary.usable());
    EXPECT_FALSE(summary.converged());
    EXPECT_EQ(certify(small.problem, t).bound_violation, 0.0);
    EXPECT_LE(q.value(t), q.value(start) * (1.0 + 1e-12));
    if (limit == 0) {
      EXPECT_EQ(t, start);
    } else {
      EXPECT_LT(q.value(t), q.value(start));
    }
  }
}

TEST_P(EverySolver, StopsAtTheTimeLimitWithAUsableDwell) {
  const SmallProblem small = random_problem({.points = 30}, 9);
  const auto q = small.quadratic();
  SolverOptions options = strict(GetParam(), 1e-12);
  options.max_seconds = 1e-9;
  Vector t = Vector::Constant(30, 0.4);
  clip_to_bounds(small.problem, t);
  const double before = q.value(t);
  const SolverSummary summary = make_solver(options)->solve(small.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::TimeLimit) << summary.message;
  EXPECT_TRUE(summary.usable());
  EXPECT_LE(q.value(t), before * (1.0 + 1e-12));
  EXPECT_EQ(certify(small.problem, t).bound_violation, 0.0);
}

TEST_P(EverySolver, ReportsProgressAndStopsWhenTold) {
  const SmallProblem small = random_problem({.points = 30}, 10);
  SolverOptions options = strict(GetParam(), 1e-12);
  std::vector<SolverProgress> seen;
  std::vector<std::string> lines;
  options.trace = [&](const SolverProgress& progress) { seen.push_back(progress); };
  options.progress.show = [&](const std::string& line) { lines.push_back(line); };
  options.progress.stop = [&] { return seen.back().iterations >= 3; };
  Vector t;
  const SolverSummary summary = make_solver(options)->solve(small.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::Interrupted) << summary.message;
  EXPECT_EQ(summary.iterations, 3);
  EXPECT_TRUE(summary.usable());
  EXPECT_FALSE(summary.converged());
  EXPECT_EQ(certify(small.problem, t).bound_violation, 0.0);
  ASSERT_EQ(seen.size(), 3u);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1].substr(0, 13), "iteration 2, ");
  EXPECT_NE(lines[1].find(" nm RMS, "), std::string::npos) << lines[1];
  const double lowest = small.quadratic().value(test::minimise_by_coordinates(small));
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_EQ(seen[k].iterations, static_cast<long>(k) + 1);
    EXPECT_GE(seen[k].seconds, 0.0);
    EXPECT_GE(seen[k].objective, lowest * (1.0 - 1e-10));
    EXPECT_GT(seen[k].residual_rms, 0.0);
    EXPECT_LE(seen[k].objective, seen[k > 0 ? k - 1 : 0].objective * (1.0 + 1e-12));
  }
}

TEST_P(EverySolver, GivesTheSameBytesTwice) {
  const SmallProblem small = random_problem({.points = 40}, 11);
  Vector first, second;
  const auto solver = make_solver(strict(GetParam()));
  const SolverSummary a = solver->solve(small.problem, first);
  const SolverSummary b = solver->solve(small.problem, second);
  ASSERT_EQ(first.size(), 40);
  EXPECT_EQ(std::memcmp(first.data(), second.data(), sizeof(double) * 40), 0);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.operator_applications, b.operator_applications);
  EXPECT_EQ(a.objective, b.objective);
}

TEST_P(EverySolver, CountsItsOperatorApplications) {
  const SmallProblem small = random_problem({.points = 10}, 12);
  const long before = small.removal->applications();
  Vector t;
  const SolverSummary summary = make_solver(strict(GetParam()))->solve(small.problem, t);
  EXPECT_EQ(summary.operator_applications, small.removal->applications() - before);
  EXPECT_GT(summary.operator_applications, 0);
  EXPECT_EQ(summary.kind, GetParam());
  EXPECT_GE(summary.seconds, 0.0);
}

TEST_P(EverySolver, RefusesABadStart) {
  const SmallProblem small = random_problem({.points = 4}, 13);
  const auto solver = make_solver(strict(GetParam()));
  for (double bad : {kNaN, kInfinity}) {
    Vector t = Vector::Ones(4);
    t[2] = bad;
    EXPECT_THROW(solver->solve(small.problem, t), std::invalid_argument);
  }
  Vector t = Vector::Ones(5);
  EXPECT_THROW(solver->solve(small.problem, t), std::invalid_argument);
}

TEST_P(EverySolver, RefusesABadProblem) {
  SmallProblem small = random_problem({.points = 4}, 14);
  small.problem.target[0] = kNaN;
  Vector t;
  EXPECT_THROW(make_solver(strict(GetParam()))->solve(small.problem, t), std::invalid_argument);
}

TEST_P(EverySolver, FailsSoonOnAnOperatorThatReturnsNaN) {
  const SmallProblem good = random_problem({.points = 4, .terms = false}, 15);
  Eigen::MatrixXd a = good.a;
  a(17, 2) = kNaN;
  const SmallProblem bad(a, good.problem.target);
  SolverOptions options = strict(GetParam());
  options.max_seconds = 5.0;
  Vector t;
  const SolverSummary summary = make_solver(options)->solve(bad.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::Failed) << summary.message;
  EXPECT_FALSE(summary.usable());
  EXPECT_FALSE(summary.converged());
}

TEST(SolverOptions, AreNamedWhenOutOfRange) {
  const auto rejects = [](auto change, const char* name) {
    SolverOptions options;
    change(options);
    expect_input_error([&] { make_solver(options); }, {name, "required"});
  };
  for (double bad : {0.0, -1.0, kNaN, kInfinity})
    rejects([&](SolverOptions& o) { o.gradient_tolerance = bad; }, "gradient_tolerance");
  for (double bad : {-1.0, kNaN, kInfinity})
    rejects([&](SolverOptions& o) { o.objective_tolerance = bad; }, "objective_tolerance");
  for (double bad : {0.0, -1.0, kNaN}) rejects([&](SolverOptions& o) { o.max_seconds = bad; }, "max_seconds");
  rejects([](SolverOptions& o) { o.settle_iterations = 0; }, "settle_iterations");
  rejects([](SolverOptions& o) { o.max_iterations = -1; }, "max_iterations");
}

TEST(SolverKind, IsReadAndWrittenByTheSameWords) {
  for (SolverKind kind : {SolverKind::ProjectedCg, SolverKind::DenseNnls})
    EXPECT_EQ(parse_solver_kind(to_string(kind)), kind);
  expect_input_error([] { parse_solver_kind("simplex"); }, {"simplex", "projected-cg", "dense-nnls"});
}

TEST(SolverSummary, StartsPessimistic) {
  const SolverSummary summary;
  EXPECT_EQ(summary.status, SolverStatus::NotRun);
  EXPECT_FALSE(summary.usable());
  EXPECT_FALSE(summary.converged());
  EXPECT_EQ(to_string(summary.status), "not run");
}

}  // namespace
}  // namespace dwell
