// The answer belongs to the problem and not to the solver, once time has a price.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solvers/matched/time_price.h"
#include "solvers/problem/certificate.h"
#include "solvers/solver_catalogue.h"
#include "tests/solvers/matched/rastered_part.h"

namespace dwell {
namespace {

using test::RasteredPart;

struct Answer {
  SolverKind kind = SolverKind::Auto;
  SolverSummary summary;
  double objective = 0.0, residual_rms = 0.0, total = 0.0;
};

std::vector<Answer> answers(const DwellProblem& problem, double objective_tolerance) {
  std::vector<Answer> all;
  for (const SolverKind kind :
       {SolverKind::Auto, SolverKind::ProjectedLbfgs, SolverKind::ProjectedCg, SolverKind::SpectralProjectedGradient,
        SolverKind::Lbfgsb, SolverKind::NloptLbfgs, SolverKind::NloptTnewton, SolverKind::NloptMma}) {
    SolverOptions options;
    options.kind = kind;
    options.objective_tolerance = objective_tolerance;
    Answer answer{kind, {}};
    Vector t;
    answer.summary = make_solver(options)->solve(problem, t);
    const Certificate certificate = certify(problem, t);
    answer.objective = certificate.objective;
    answer.residual_rms = certificate.residual_rms;
    answer.total = t.sum();
    all.push_back(answer);
  }
  return all;
}

const Answer& best_of(const std::vector<Answer>& all) {
  return *std::min_element(all.begin(), all.end(),
                           [](const Answer& a, const Answer& b) { return a.objective < b.objective; });
}

TEST(SameAnswer, ComesFromEverySolverThatSaysSo) {
  for (const RasteredPart::Recipe& recipe : {RasteredPart::Recipe{.step = 3}, RasteredPart::Recipe{.step = 5},
                                             RasteredPart::Recipe{.step = 3, .ripple = 60.0}}) {
    RasteredPart part(recipe);
    find_time_price(part.problem, {}, {});
    const std::vector<Answer> all = answers(part.problem, 1e-5);
    const Answer& best = best_of(all);
    int agree = 0;
    for (const Answer& a : all) {
      SCOPED_TRACE(testing::Message() << to_string(a.kind) << ", step " << recipe.step << ", ripple " << recipe.ripple
                                      << ": " << a.summary.message);
      if (!a.summary.converged()) continue;
      ++agree;
      EXPECT_NEAR(a.objective, best.objective, 1e-4 * best.objective);
      EXPECT_NEAR(a.residual_rms, best.residual_rms, 5e-3 * best.residual_rms);
      EXPECT_NEAR(a.total, best.total, 0.03 * best.total);
    }
    EXPECT_GE(agree, 4);
  }
}

}  // namespace
}  // namespace dwell
