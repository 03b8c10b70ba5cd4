#include "solvers/matched/time_price.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/errors.h"
#include "solvers/solver_catalogue.h"
#include "tests/solvers/matched/rastered_part.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

using test::RasteredPart;

/// The plan of a problem with a price, by the solver that makes no use of coarse models.
LeftAndTotal solved(DwellProblem& p, double price) {
  p.gamma = price * static_cast<double>(p.pixels());
  SolverOptions options;
  options.kind = SolverKind::ProjectedLbfgs;
  options.objective_tolerance = 3e-4;
  options.max_iterations = 600;  // enough for residual and total, if not for the tolerance next to a price of 0
  Vector t, r;
  const SolverSummary summary = make_solver(options)->solve(p, t);
  EXPECT_TRUE(summary.usable()) << summary.message;
  DwellObjective(p).residual(t, r);
  return {0.5 * r.squaredNorm() / static_cast<double>(p.pixels()), t.sum()};
}

LeftAndTotal least_of(const DwellProblem& p) {
  Vector r;
  DwellObjective(p).residual(p.lower, r);
  return {0.5 * r.squaredNorm() / static_cast<double>(p.pixels()), p.lower.sum()};
}

TEST(TimePrice, IsTheWorthOfThePlanThatItMakes) {
  const RasteredPart::Recipe dense{}, sparse{.step = 6}, rough{.ripple = 60.0}, narrow{.step = 2, .fwhm = 0.8};
  for (const RasteredPart::Recipe& recipe : {dense, sparse, rough, narrow}) {
    SCOPED_TRACE(testing::Message() << "step " << recipe.step << ", FWHM " << recipe.fwhm << ", ripple "
                                    << recipe.ripple);
    RasteredPart part(recipe);
    const TimePrice found = find_time_price(part.problem, {}, {});
    EXPECT_DOUBLE_EQ(part.problem.gamma, found.price * static_cast<double>(part.problem.pixels()));
    const LeftAndTotal least = least_of(part.problem), plan = solved(part.problem, found.price);
    const RuledPrice ruled = worth_of_time({}, least, plan);
    EXPECT_NEAR(ruled.price, found.price, 0.05 * found.price);
    EXPECT_EQ(ruled.rule, found.rule);
    EXPECT_EQ(found.rule, recipe.ripple > 10.0 ? PriceRule::Average : PriceRule::Share);
    EXPECT_NEAR(found.least.residual_rms, std::sqrt(2.0 * least.half_mean_square), 1e-9);
    EXPECT_LT(plan.half_mean_square, 0.95 * least.half_mean_square);  // something is removed
    // The smallest such price: at half of it time is worth more than it costs.
    EXPECT_GT(worth_of_time({}, least, solved(part.problem, 0.5 * found.price)).price, 0.5 * found.price);
    // What half and twice the price would give, and the least that is left, are near what they turn out to be.
    for (const PricedTradeOff& estimate : {found.half, found.twice}) {
      const LeftAndTotal real = solved(part.problem, estimate.price);
      EXPECT_NEAR(estimate.trade_off.residual_rms, std::sqrt(2.0 * real.half_mean_square),
                  0.03 * estimate.trade_off.residual_rms);
      EXPECT_NEAR(estimate.trade_off.total, real.total, 0.05 * real.total);
    }
    EXPECT_LT(found.best.trade_off.residual_rms, found.half.trade_off.residual_rms);
    EXPECT_NEAR(found.best.trade_off.residual_rms,
                std::sqrt(2.0 * solved(part.problem, found.best.price).half_mean_square),
                0.03 * found.best.trade_off.residual_rms);
  }
}

TEST(TimePrice, FollowsTheScaleOfHeightsAndRates) {
  const auto price = [](const RasteredPart::Recipe& recipe) {
    RasteredPart part(recipe);
    return find_time_price(part.problem, {}, {}).price;
  };
  const double plain = price({});
  // Heights and all that is left x 10, time x 10: mean square over time x 10. Rates x 10: time / 10.
  EXPECT_NEAR(price({.height = 400.0, .ripple = 10.0}), 10.0 * plain, 0.03 * 10.0 * plain);
  EXPECT_NEAR(price({.rate = 20.0}), 10.0 * plain, 0.03 * 10.0 * plain);
  EXPECT_NEAR(price({.step = 2}), plain, 0.03 * plain);
}

TEST(TimePrice, IsZeroWhereNothingIsToBeRemoved) {
  RasteredPart part({.height = 0.0, .ripple = 0.0});
  const TimePrice found = find_time_price(part.problem, {}, {});
  EXPECT_EQ(found.price, 0.0);
  EXPECT_EQ(found.models, 0);
  EXPECT_EQ(part.problem.gamma, 0.0);
}

TEST(TimePrice, IsFoundWithoutGeometryAndWithUpperBounds) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    test::SmallProblem small = test::random_problem({.points = 30}, seed);
    small.problem.reference = small.problem.lower;  // else the least dwell is not the cheapest
    const TimePrice found = find_time_price(small.problem, {}, {});
    const Vector t = minimise_by_coordinates(small);
    Vector r;
    DwellObjective(small.problem).residual(t, r);
    const double m = static_cast<double>(small.problem.pixels());
    const RuledPrice ruled = worth_of_time({}, least_of(small.problem), {0.5 * r.squaredNorm() / m, t.sum()});
    EXPECT_NEAR(ruled.price, found.price, 0.03 * found.price) << seed;
  }
}

TEST(TimePrice, IsTheSameForAnyThreadsAndStopsWhenAsked) {
  RasteredPart one({}), two({});
  two.geometry->threads = 2;
  EXPECT_NEAR(find_time_price(one.problem, {}, {}).price, find_time_price(two.problem, {}, {}).price, 1e-9);
  int asked = 0;
  Progress progress;
  progress.stop = [&asked] { return ++asked > 4; };
  EXPECT_THROW(find_time_price(one.problem, {}, progress), Interrupted);
}

}  // namespace
}  // namespace dwell
