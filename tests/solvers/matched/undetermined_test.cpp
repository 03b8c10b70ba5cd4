// Without weights a problem of noise has no answer; a solver that says so at once is worth more than one at its limit.

#include <gtest/gtest.h>

#include <random>

#include "solvers/problem/certificate.h"
#include "solvers/solver_catalogue.h"
#include "tests/solvers/matched/rastered_part.h"

namespace dwell {
namespace {

using test::RasteredPart;

/// A part with noise, which a tool of many pixels fits ever better by ever more dwell.
RasteredPart noisy_part(Index step) {
  RasteredPart part({.step = step, .fwhm = 1.4, .ripple = 0.0});
  std::mt19937_64 random(11);
  for (double& z : part.problem.target) z += 8.0 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
  part.problem.alpha = 0.0;
  return part;
}

TEST(Undetermined, IsSaidWellBeforeTheLimit) {
  RasteredPart part = noisy_part(1);
  for (const SolverKind kind : {SolverKind::Auto, SolverKind::ProjectedLbfgs, SolverKind::Lbfgsb}) {
    SolverOptions options;
    options.kind = kind;
    Vector t;
    const SolverSummary summary = make_solver(options)->solve(part.problem, t);
    ASSERT_EQ(summary.status, SolverStatus::Undetermined) << to_string(kind) << ": " << summary.message;
    EXPECT_FALSE(summary.converged());
    EXPECT_TRUE(summary.usable());
    EXPECT_NE(summary.message.find("no dwell is the answer"), std::string::npos) << summary.message;
    EXPECT_LT(static_cast<double>(summary.iterations) + summary.coarse_pairs,
              0.75 * static_cast<double>(options.max_iterations));
    EXPECT_LE(certify(part.problem, t).bound_violation, 0.0);
  }
}

TEST(Undetermined, IsNeverSaidWhereAWeightIsAboveZero) {
  for (const int which : {0, 1, 2}) {
    RasteredPart part = noisy_part(1);
    if (which == 0) part.problem.alpha = 1e-6 * part.geometry->kernel.energy;
    if (which == 1) part.problem.gamma = 1e-6;
    if (which == 2) part.problem.beta = 1e-9;
    Vector t;
    const SolverSummary summary = make_solver({})->solve(part.problem, t);
    EXPECT_NE(summary.status, SolverStatus::Undetermined) << which << ": " << summary.message;
  }
}

// Points so few that the dwell is determined by the surface alone.
TEST(Undetermined, IsNotSaidWhereTheSurfaceDecides) {
  RasteredPart part = noisy_part(6);
  for (const SolverKind kind : {SolverKind::Auto, SolverKind::ProjectedLbfgs}) {
    SolverOptions options;
    options.kind = kind;
    Vector t;
    const SolverSummary summary = make_solver(options)->solve(part.problem, t);
    EXPECT_TRUE(summary.converged()) << to_string(kind) << ": " << summary.message;
  }
}

}  // namespace
}  // namespace dwell
