// Every solver on random small problems against the dense active-set solver.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "core/base/errors.h"
#include "core/removal/sparse_removal.h"
#include "solvers/problem/certificate.h"
#include "solvers/solver_catalogue.h"
#include "tests/solvers/problem/random_problem.h"

namespace dwell {
namespace {

constexpr double kGradientTolerance = 1e-7;

SolverOptions tight(SolverKind kind) {
  SolverOptions o;
  o.kind = kind;
  o.gradient_tolerance = kGradientTolerance;
  o.objective_tolerance = 0.0;
  o.max_iterations = kind == SolverKind::SpectralProjectedGradient ? 200'000 : 20'000;
  return o;
}

class NativeSolvers : public testing::TestWithParam<SolverKind> {};

/// For convex q and any feasible t: q(t) - q(t*) <= projected gradient . (t - t*), since where the gradient is not in
/// the projected one it pushes t out of the box, and t* is inside. So a gradient of eps |A'z| bounds the gap by
/// eps |A'z| |t - t*|: no conditioning enters. The oracle is as good as its own certificate, so both sides count.
TEST_P(NativeSolvers, AgreesWithTheOracle) {
  for (Special special : {Special::None, Special::ZeroTarget, Special::NegativeTarget, Special::OnePoint,
                          Special::OnePixel, Special::Repeated}) {
    const unsigned seeds = special == Special::None || special == Special::Repeated ? 100 : 15;
    for (unsigned seed = 0; seed < seeds; ++seed) {
      SCOPED_TRACE(testing::Message() << "special " << static_cast<int>(special) << ", seed " << seed);
      RandomProblem random(seed, special);
      const DwellProblem& p = random.problem;
      Vector expected, t;
      const SolverSummary oracle = make_solver(tight(SolverKind::DenseNnls))->solve(p, expected);
      ASSERT_TRUE(oracle.usable()) << oracle.message;
      const SolverSummary summary = make_solver(tight(GetParam()))->solve(p, t);
      ASSERT_TRUE(summary.converged()) << to_string(summary.status) << ": " << summary.message;
      const Certificate ours = certify(p, t), theirs = certify(p, expected);
      DwellObjective objective(p);
      const double scale = objective.gradient_scale() > 0.0 ? objective.gradient_scale() : 1.0;
      const double distance = (t - expected).norm();
      const double rounding = 1e-12 * (std::abs(theirs.objective) + 0.5 * p.target.squaredNorm());
      EXPECT_LE(ours.objective - theirs.objective, ours.projected_gradient * scale * distance + rounding);
      EXPECT_LE(theirs.objective - ours.objective, theirs.projected_gradient * scale * distance + rounding);
      EXPECT_LE(ours.bound_violation, 0.0);
      // What the summary says is what an independent evaluation finds.
      EXPECT_NEAR(summary.objective, ours.objective, 1e-9 * (std::abs(ours.objective) + p.target.squaredNorm()));
      if (summary.status == SolverStatus::Converged) {
        EXPECT_LE(ours.projected_gradient, 1.01 * kGradientTolerance);
      } else {
        EXPECT_LE(ours.projected_gradient, 1e-4);
      }
    }
  }
}

TEST_P(NativeSolvers, BoundsOfBothKindsHoldInTheRandomProblems) {
  Index at_lower = 0, at_upper = 0, free = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomProblem random(seed, Special::None);
    Vector t;
    make_solver(tight(GetParam()))->solve(random.problem, t);
    for (Index j = 0; j < t.size(); ++j) {
      const bool low = t[j] <= random.problem.lower[j], high = t[j] >= random.problem.upper_at(j);
      at_lower += low;
      at_upper += high;
      free += !low && !high;
    }
  }
  EXPECT_GT(at_lower, 20);
  EXPECT_GT(at_upper, 20);
  EXPECT_GT(free, 20);
}

TEST_P(NativeSolvers, WarmStartFromTheAnswerIsNoWorse) {
  RandomProblem random(3, Special::None);
  Vector t;
  const SolverSummary first = make_solver(tight(GetParam()))->solve(random.problem, t);
  Vector again = t;
  const SolverSummary second = make_solver(tight(GetParam()))->solve(random.problem, again);
  EXPECT_TRUE(second.converged()) << second.message;
  EXPECT_LE(second.objective, first.objective + 1e-12 * std::abs(first.objective));
  EXPECT_LE(second.iterations, 3);
}

TEST_P(NativeSolvers, TheSameInputGivesTheSameBytes) {
  RandomProblem a(5, Special::None), b(5, Special::None);
  Vector ta, tb;
  make_solver(tight(GetParam()))->solve(a.problem, ta);
  make_solver(tight(GetParam()))->solve(b.problem, tb);
  EXPECT_TRUE(ta == tb);
}

TEST_P(NativeSolvers, LimitsLeaveAUsableDwell) {
  RandomProblem random(1, Special::None);
  random.problem.upper.resize(0);  // or three iterations reach the corner of the box
  Vector start = random.problem.lower;
  const double before = certify(random.problem, start).objective;
  SolverOptions o = tight(GetParam());
  o.gradient_tolerance = 1e-14;
  o.max_iterations = 2;
  Vector t = start;
  SolverSummary summary = make_solver(o)->solve(random.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::IterationLimit) << summary.message;
  EXPECT_TRUE(summary.usable());
  EXPECT_LE(certify(random.problem, t).objective, before);

  o.max_iterations = 0;
  t = start;
  summary = make_solver(o)->solve(random.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::IterationLimit);
  EXPECT_TRUE(t == start);

  o.max_iterations = 1000;
  o.max_seconds = 1e-9;
  summary = make_solver(o)->solve(random.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::TimeLimit);
  EXPECT_LE(certify(random.problem, t).objective, before);

  o.max_seconds = 100.0;
  o.progress.stop = [] { return true; };
  t = start;
  summary = make_solver(o)->solve(random.problem, t);
  EXPECT_EQ(summary.status, SolverStatus::Interrupted);
  EXPECT_EQ(summary.iterations, 1);
  EXPECT_LE(certify(random.problem, t).objective, before);
}

TEST_P(NativeSolvers, RefusesWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RandomProblem random(2, Special::None);
  const auto solver = make_solver(tight(GetParam()));
  Vector t;
  for (Vector* v : {&random.problem.target, &random.problem.lower}) {
    const double kept = (*v)[1];
    for (double bad : {nan, std::numeric_limits<double>::infinity()}) {
      (*v)[1] = bad;
      EXPECT_THROW(solver->solve(random.problem, t), std::invalid_argument);
    }
    (*v)[1] = kept;
  }
  Vector start = random.problem.lower;
  start[0] = nan;
  EXPECT_THROW(solver->solve(random.problem, start), std::invalid_argument);
}

std::vector<SolverKind> native_solvers() {
  std::vector<SolverKind> kinds;
  for (const SolverRecord& record : solver_catalogue()) {
    if (!record.peer) kinds.push_back(record.kind);
  }
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Native, NativeSolvers, testing::ValuesIn(native_solvers()), [](const auto& instance) {
  std::string name = to_string(instance.param);
  std::erase(name, '-');
  return name;
});

TEST(SolverCatalogue, RefusesMoreDwellPointsThanARecordSays) {
  for (const SolverRecord& record : solver_catalogue()) {
    if (!record.largest) continue;
    SCOPED_TRACE(record.name);
    const Index n = *record.largest + 1;
    SparseRemoval removal(SparseRemoval::Matrix(1, n), 1);
    DwellProblem p;
    p.removal = &removal;
    p.target = Vector::Ones(1);
    p.lower = Vector::Zero(n);
    Vector t;
    EXPECT_THROW(make_solver(tight(record.kind))->solve(p, t), InputError);
  }
}

TEST(SolverCatalogue, HasWordsThatReadBackAndAreUnique) {
  std::set<std::string> names;
  for (const SolverRecord& record : solver_catalogue()) {
    EXPECT_EQ(parse_solver_kind(record.name), record.kind);
    EXPECT_EQ(to_string(record.kind), record.name);
    EXPECT_FALSE(record.about.empty()) << record.name;
    names.insert(record.name);
  }
  EXPECT_EQ(names.size(), solver_catalogue().size());
  EXPECT_THROW(parse_solver_kind("simplex"), InputError);
}

}  // namespace
}  // namespace dwell
