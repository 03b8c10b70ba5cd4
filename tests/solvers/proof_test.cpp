// What --certify asks of a solve: to go on until the objective is proven to be near the optimum's.

#include "solvers/proof.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "solvers/matched/time_price.h"
#include "solvers/solver_catalogue.h"
#include "tests/solvers/matched/rastered_part.h"

namespace dwell {
namespace {

using test::RasteredPart;

struct Solved {
  Vector t;
  SolverSummary summary;
  Certificate certificate;
};

Solved solved(const DwellProblem& problem, const SolverOptions& options) {
  Solved s;
  s.summary = make_solver(options)->solve(problem, s.t);
  s.certificate = certify(problem, s.t);
  return s;
}

TEST(Proof, GoesOnUntilTheOptimumIsNearWithEverySolver) {
  RasteredPart part({.step = 3});
  find_time_price(part.problem, {}, {});
  SolverOptions strict;
  strict.kind = SolverKind::ProjectedCg;
  strict.objective_tolerance = 0.0;
  strict.gradient_tolerance = 1e-8;
  strict.max_iterations = 20'000;
  const Solved best = solved(part.problem, strict);
  ASSERT_TRUE(best.summary.converged()) << best.summary.message;
  for (const SolverKind kind :
       {SolverKind::Auto, SolverKind::ProjectedLbfgs, SolverKind::ProjectedCg, SolverKind::Lbfgsb}) {
    SCOPED_TRACE(to_string(kind));
    SolverOptions options;
    options.kind = kind;
    Solved s = solved(part.problem, options);
    const Solved first = s;
    for (const double gap : {1e-2, 1e-4}) {
      prove_optimum(part.problem, options, gap, s.t, s.summary, s.certificate);
      EXPECT_TRUE(s.summary.converged()) << s.summary.message;
      EXPECT_LE(s.certificate.gap(), gap);
      EXPECT_LE(s.certificate.objective - best.certificate.objective, gap * best.certificate.objective);
      EXPECT_LE(s.certificate.lower_bound, best.certificate.objective * (1.0 + 1e-9));
      EXPECT_NEAR(s.certificate.objective, certify(part.problem, s.t).objective, 1e-12 * s.certificate.objective);
    }
    EXPECT_GT(s.summary.iterations, first.summary.iterations);
    EXPECT_GT(s.summary.operator_applications, first.summary.operator_applications);
  }
}

TEST(Proof, LeavesAnAnswerAsItIsThatIsProvenAlready) {
  RasteredPart part({.step = 3});
  find_time_price(part.problem, {}, {});
  Solved s = solved(part.problem, {});
  const Vector before = s.t;
  const long iterations = s.summary.iterations;
  prove_optimum(part.problem, {}, 10.0, s.t, s.summary, s.certificate);
  EXPECT_EQ(s.t, before);
  EXPECT_EQ(s.summary.iterations, iterations);
}

TEST(Proof, EndsWithoutOneWhereTheLimitsAreReached) {
  RasteredPart part({.step = 3});
  find_time_price(part.problem, {}, {});
  SolverOptions options;
  Solved s = solved(part.problem, options);
  ASSERT_TRUE(s.summary.converged());
  options.max_iterations = 1;
  prove_optimum(part.problem, options, 1e-6, s.t, s.summary, s.certificate);
  EXPECT_EQ(s.summary.status, SolverStatus::IterationLimit) << s.summary.message;
  EXPECT_GT(s.certificate.gap(), 1e-6);
  EXPECT_THROW(prove_optimum(part.problem, options, 0.0, s.t, s.summary, s.certificate), std::invalid_argument);
}

// A tolerance so loose that the solver rests after its first look.
SolverOptions hasty() {
  SolverOptions options;
  options.kind = SolverKind::ProjectedLbfgs;
  options.objective_tolerance = 1e6;
  options.settle_iterations = 2;
  return options;
}

TEST(Doubt, GoesOnFromASettledAnswerFarFromTheOptimum) {
  RasteredPart part({.step = 3});
  find_time_price(part.problem, {}, {});
  SolverOptions options = hasty();
  Solved s = solved(part.problem, options);
  ASSERT_EQ(s.summary.status, SolverStatus::Settled) << s.summary.message;
  ASSERT_GT(s.certificate.gap(), kSettledGap);
  const long before = s.summary.iterations;
  doubt_settled(part.problem, options, s.t, s.summary);
  EXPECT_TRUE(s.summary.converged()) << s.summary.message;
  EXPECT_GT(s.summary.iterations, before);
  EXPECT_LE(certify(part.problem, s.t).gap(), kSettledGap);
}

TEST(Doubt, SaysStalledOfAnAnswerThatItCannotProve) {
  RasteredPart part({.step = 3});
  find_time_price(part.problem, {}, {});
  SolverOptions options = hasty();
  Solved s = solved(part.problem, options);
  options.objective_tolerance = 1e-11;  // no stricter one is left to go on with
  doubt_settled(part.problem, options, s.t, s.summary);
  EXPECT_EQ(s.summary.status, SolverStatus::Stalled);
  EXPECT_NE(s.summary.message.find("not proven to be within 100 % of the optimum's"), std::string::npos)
      << s.summary.message;
}

TEST(Doubt, EndsWithTheLimitThatCutItShort) {
  RasteredPart part({.step = 3});
  find_time_price(part.problem, {}, {});
  Solved s = solved(part.problem, hasty());
  SolverOptions options = hasty();
  options.objective_tolerance = 1e-8;
  options.max_iterations = 3;
  doubt_settled(part.problem, options, s.t, s.summary);
  EXPECT_EQ(s.summary.status, SolverStatus::IterationLimit);
  EXPECT_NE(s.summary.message.find("what is proven is"), std::string::npos) << s.summary.message;
}

TEST(Doubt, HasNothingToSayWithoutABound) {
  RasteredPart part({.step = 3});
  part.problem.gamma = 0.0;
  Solved s = solved(part.problem, hasty());
  const SolverSummary before = s.summary;
  doubt_settled(part.problem, hasty(), s.t, s.summary);
  EXPECT_EQ(s.summary.status, before.status);
  EXPECT_EQ(s.summary.iterations, before.iterations);
}

}  // namespace
}  // namespace dwell
