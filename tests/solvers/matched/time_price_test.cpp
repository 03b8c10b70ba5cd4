#include "solvers/matched/time_price.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/base/errors.h"
#include "core/form/form.h"
#include "core/removal/removal_geometry.h"
#include "core/tif/models/removal_models.h"
#include "solvers/solver_catalogue.h"
#include "tests/solvers/problem/small_problem.h"

namespace dwell {
namespace {

/// A part cut off at a corner and a raster over it.
struct RasteredPart {
  std::shared_ptr<RemovalGeometry> geometry = std::make_shared<RemovalGeometry>();
  std::unique_ptr<RemovalOperator> removal;
  DwellProblem problem;

  struct Recipe {
    Index step = 1;        // of dwell points and lines, in pixels
    double fwhm = 3.0;     // of the tool, in mm; a pixel is 0.2 by 0.25 mm
    double rate = 2.0;     // of the tool, nm/s
    double height = 40.0;  // nm
    double ripple = 1.0;   // nm, which no tool reaches
  };

  explicit RasteredPart(const Recipe& recipe) {
    RemovalGeometry& g = *geometry;
    g.lattice = {48, 60, 0.2, 0.25, {-3.0, 5.0}};
    for (Index i = 0; i < g.lattice.size(); ++i) {
      if (i / g.lattice.cols + i % g.lattice.cols > 20) g.pixels.push_back(i);
    }
    g.kernel = removal_kernel(gaussian_removal(recipe.rate, recipe.fwhm, 1.5 * recipe.fwhm), 0.2, 0.25);
    ToolPath path;
    for (Index r = -6; r < 54; r += recipe.step) {
      for (Index k = -6; k < 66; k += recipe.step) {
        path.points.push_back(g.lattice.centre(r, (r / recipe.step) % 2 == 0 ? k : 60 - k));
      }
    }
    path.lifted.assign(path.points.size(), 0);
    g.strokes = halting_strokes(path);
    removal = make_removal_operator(g);
    DwellProblem& p = problem;
    p.removal = removal.get();
    p.target.resize(removal->rows());
    for (Index i = 0; i < p.target.size(); ++i) {
      const Index pixel = g.pixels[static_cast<std::size_t>(i)];
      const Point q = g.lattice.centre(pixel);
      p.target[i] =
          recipe.height * (std::sin(0.6 * q.x) * std::cos(0.5 * q.y) + 0.1 * std::sin(1.1 * q.y + 0.5 * q.x)) +
          recipe.ripple * ((pixel / g.lattice.cols + pixel % g.lattice.cols) % 2 == 0 ? 1.0 : -1.0);
    }
    p.form = form_basis(g.lattice, g.pixels, {true, true, false}, {});
    p.parts = {{geometry, path_smoothness(path, g.strokes)}};
    p.alpha = 0.01 * g.kernel.energy;
    p.lower = Vector::Zero(removal->cols());
  }
};

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
  EXPECT_NEAR(price({.height = 400.0, .ripple = 10.0}), 10.0 * plain, 0.01 * 10.0 * plain);
  EXPECT_NEAR(price({.rate = 20.0}), 10.0 * plain, 0.01 * 10.0 * plain);
  EXPECT_NEAR(price({.step = 2}), plain, 0.02 * plain);
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
