#include "solvers/native/questioned_solver.h"

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "solvers/native/projected_lbfgs.h"
#include "solvers/problem/certificate.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

using test::random_problem;
using test::SmallProblem;

/// Says that it has settled where it starts, as a solver does that is caught there.
class Caught final : public DwellSolver {
 public:
  explicit Caught(SolverOptions options) : DwellSolver(std::move(options)) {}

 private:
  void do_solve(const DwellProblem& problem, Vector& t, SolverSummary& summary) override {
    summary.status = SolverStatus::Settled;
    summary.iterations = 25;
    summary.objective = certify(problem, t).objective;
    summary.message = "settled";
  }
};

SolverSummary question_at(const SmallProblem& small, Vector& t, SolverOptions options = {}) {
  return QuestionedSolver(std::make_unique<Caught>(options), options).solve(small.problem, t);
}

TEST(QuestionedSolver, DoesNotTakeSettledOnTrust) {
  const SmallProblem small = random_problem({.points = 40}, 3);
  const Vector start = small.problem.lower;
  Vector t = start;
  const SolverSummary summary = question_at(small, t);
  EXPECT_EQ(summary.status, SolverStatus::Stalled) << summary.message;
  EXPECT_FALSE(summary.converged());
  EXPECT_TRUE(summary.usable());
  EXPECT_NE(summary.message.find("of projected-lbfgs from there lower it by"), std::string::npos) << summary.message;
  EXPECT_EQ(t, start);  // the answer is the solver's own
  EXPECT_EQ(summary.objective, certify(small.problem, start).objective);
}

TEST(QuestionedSolver, BelievesItWhereLittleIsLeft) {
  const SmallProblem small = random_problem({.points = 40}, 3);
  SolverOptions exact;
  exact.gradient_tolerance = 1e-12;
  exact.objective_tolerance = 0.0;
  Vector t;
  ASSERT_TRUE(ProjectedLbfgs(exact).solve(small.problem, t).usable());
  const SolverSummary summary = question_at(small, t);
  EXPECT_EQ(summary.status, SolverStatus::Settled) << summary.message;
  EXPECT_EQ(summary.message, "settled");
  EXPECT_GT(summary.operator_applications, 0);  // the question is work, and is counted
}

TEST(QuestionedSolver, SaysThatTimeIsUpWhereNoneIsLeftToAsk) {
  const SmallProblem small = random_problem({.points = 40}, 3);
  SolverOptions options;
  options.max_seconds = 1e-12;
  Vector t;
  const SolverSummary summary = question_at(small, t, options);
  EXPECT_EQ(summary.status, SolverStatus::TimeLimit) << summary.message;
  EXPECT_NE(summary.message.find("settled; questioned: "), std::string::npos) << summary.message;
}

TEST(QuestionedSolver, StopsWhenItIsInterrupted) {
  const SmallProblem small = random_problem({.points = 40}, 3);
  SolverOptions options;
  options.progress.stop = [] { return true; };
  Vector t;
  EXPECT_EQ(question_at(small, t, options).status, SolverStatus::Interrupted);
}

}  // namespace
}  // namespace dwell
