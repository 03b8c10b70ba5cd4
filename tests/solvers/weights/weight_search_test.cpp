#include "solvers/weights/weight_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include "solvers/weights/nlopt_search.h"

namespace dwell {
namespace {

constexpr double kPriceScale = 0.1;

/// A made-up mirror: residual rises, steps and total fall with the weights, each smoothly and for ever.
TradeOff smooth_trade_off(const Weights& w) {
  const double s = w.smoothness, p = w.time_price / kPriceScale;
  return {0.13 + 0.002 * std::pow(s, 0.5) + 0.3 * p, 400.0 / (1.0 + std::pow(30.0 * p, 0.3)) + 1e-3 / (1.0 + s),
          0.003 + 0.04 / (1.0 + std::pow(1000.0 * s, 0.8)) + 1e-3 * p};
}

WeightSearchOptions options_of(const WeightGoal& smoothness, const WeightGoal& price) {
  WeightSearchOptions options;
  options.smoothness = smoothness;
  options.time_price = price;
  options.time_price_range = time_price_range(kPriceScale);
  return options;
}

const WeightTrial& chosen(const WeightSearchResult& result) { return result.trials.at(result.chosen); }

const WeightGoal kNoPrice{0.0, GoalKind::Fixed}, kSomeSmoothness{0.1, GoalKind::Fixed};

struct Target {
  const char* name;
  WeightGoal smoothness, price;
  double TradeOff::*quantity;
  bool least;  // the least weight that meets it is wanted, not the largest
};
void PrintTo(const Target& t, std::ostream* out) { *out << t.name; }

class OneTarget : public testing::TestWithParam<Target> {};

TEST_P(OneTarget, IsMetCloselyByTheExtremeWeightThatMeetsIt) {
  const Target& target = GetParam();
  const bool smooth = target.smoothness.kind != GoalKind::Fixed;
  const double limit = smooth ? target.smoothness.value : target.price.value;
  const auto result = search_weights(options_of(target.smoothness, target.price),
                                     [](const Weights& w) { return std::optional(smooth_trade_off(w)); });
  const WeightTrial& best = chosen(result);
  EXPECT_TRUE(result.met());
  EXPECT_LE(best.trade_off.*target.quantity, limit);
  EXPECT_GE(best.trade_off.*target.quantity, 0.995 * limit);
  EXPECT_LE(result.trials.size(), 14u);
  // The quantity is monotone in the weight: 2 % of it on the other side of the best weight misses the target.
  Weights beyond = best.weights;
  (smooth ? beyond.smoothness : beyond.time_price) *= target.least ? 0.9 : 1.1;
  EXPECT_GT(smooth_trade_off(beyond).*target.quantity, 0.995 * best.trade_off.*target.quantity);
  EXPECT_EQ(smooth ? best.weights.time_price : best.weights.smoothness, smooth ? 0.0 : 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    Search, OneTarget,
    testing::Values(
        Target{"step_loose", {0.02, GoalKind::StepAtMost}, kNoPrice, &TradeOff::step_rms, true},
        Target{"step", {0.004, GoalKind::StepAtMost}, kNoPrice, &TradeOff::step_rms, true},
        Target{"residual_by_smoothness", {0.1305, GoalKind::ResidualAtMost}, kNoPrice, &TradeOff::residual_rms, false},
        Target{"residual_high", {0.145, GoalKind::ResidualAtMost}, kNoPrice, &TradeOff::residual_rms, false},
        Target{"total", kSomeSmoothness, {250.0, GoalKind::TotalAtMost}, &TradeOff::total, true},
        Target{"total_short", kSomeSmoothness, {120.0, GoalKind::TotalAtMost}, &TradeOff::total, true},
        Target{"residual_by_price", kSomeSmoothness, {0.15, GoalKind::ResidualAtMost}, &TradeOff::residual_rms, false}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(WeightSearch, ATargetMetWithoutAnyWeightNeedsNone) {
  const auto evaluate = [](const Weights& w) { return std::optional(smooth_trade_off(w)); };
  const auto steps = search_weights(options_of({0.5, GoalKind::StepAtMost}, kNoPrice), evaluate);
  EXPECT_EQ(chosen(steps).weights.smoothness, 0.0);
  const auto total = search_weights(options_of(kSomeSmoothness, {500.0, GoalKind::TotalAtMost}), evaluate);
  EXPECT_EQ(chosen(total).weights.time_price, 0.0);
  const auto residual = search_weights(options_of(kSomeSmoothness, {5.0, GoalKind::ResidualAtMost}), evaluate);
  EXPECT_EQ(chosen(residual).weights.time_price, kPriceScale);
  EXPECT_TRUE(steps.met() && total.met() && residual.met());
  EXPECT_LE(std::max({steps.trials.size(), total.trials.size(), residual.trials.size()}), 6u);
}

TEST(WeightSearch, ATargetOutOfReachGivesTheEndNearestToItAndSaysSo) {
  const auto evaluate = [](const Weights& w) { return std::optional(smooth_trade_off(w)); };
  const auto steps = search_weights(options_of({0.001, GoalKind::StepAtMost}, kNoPrice), evaluate);
  EXPECT_FALSE(steps.met());
  EXPECT_GE(chosen(steps).weights.smoothness, kSmoothnessRange.most);  // beyond, the step hardly falls
  EXPECT_LT(chosen(steps).weights.smoothness, kSmoothnessRange.ceiling);
  const auto residual = search_weights(options_of(kSomeSmoothness, {0.1, GoalKind::ResidualAtMost}), evaluate);
  EXPECT_FALSE(residual.met());
  EXPECT_EQ(chosen(residual).weights.time_price, 0.0);
  EXPECT_LE(std::max(steps.trials.size(), residual.trials.size()), 7u);
}

TEST(WeightSearch, NoiseOfTheSolverDoesNotSpoilATarget) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(0.9975, 1.0025);
    const auto evaluate = [&](const Weights& w) {
      TradeOff t = smooth_trade_off(w);
      for (double TradeOff::*q : {&TradeOff::residual_rms, &TradeOff::total, &TradeOff::step_rms})
        t.*q *= noise(random);
      return std::optional(t);
    };
    const auto result = search_weights(options_of({0.006, GoalKind::StepAtMost}, kNoPrice), evaluate);
    EXPECT_TRUE(result.met()) << seed;
    EXPECT_LE(chosen(result).trade_off.step_rms, 0.006) << seed;
    EXPECT_GE(chosen(result).trade_off.step_rms, 0.98 * 0.006) << seed;
    EXPECT_LE(result.trials.size(), 20u) << seed;
    for (const WeightTrial& t : result.trials) {
      if (t.trade_off.step_rms > 0.006) continue;
      EXPECT_LE(chosen(result).weights.smoothness, t.weights.smoothness) << seed;
    }
  }
}

struct TwoTargets {
  const char* name;
  WeightGoal smoothness, price;
  double TradeOff::*by_smoothness;
  double TradeOff::*by_price;
};
void PrintTo(const TwoTargets& t, std::ostream* out) { *out << t.name; }

class BothTargets : public testing::TestWithParam<TwoTargets> {};

TEST_P(BothTargets, AreMetTogetherClosely) {
  const TwoTargets& t = GetParam();
  const auto result = search_weights(options_of(t.smoothness, t.price),
                                     [](const Weights& w) { return std::optional(smooth_trade_off(w)); });
  EXPECT_TRUE(result.met());
  const TradeOff& best = chosen(result).trade_off;
  EXPECT_LE(best.*t.by_smoothness, t.smoothness.value);
  EXPECT_LE(best.*t.by_price, t.price.value);
  EXPECT_GE(best.*t.by_smoothness, 0.97 * t.smoothness.value);
  EXPECT_GE(best.*t.by_price, 0.97 * t.price.value);
  EXPECT_LE(result.trials.size(), 40u);
}

INSTANTIATE_TEST_SUITE_P(Search, BothTargets,
                         testing::Values(TwoTargets{"step_and_total",
                                                    {0.006, GoalKind::StepAtMost},
                                                    {250.0, GoalKind::TotalAtMost},
                                                    &TradeOff::step_rms,
                                                    &TradeOff::total},
                                         TwoTargets{"step_and_residual",
                                                    {0.006, GoalKind::StepAtMost},
                                                    {0.15, GoalKind::ResidualAtMost},
                                                    &TradeOff::step_rms,
                                                    &TradeOff::residual_rms},
                                         TwoTargets{"residual_and_total",
                                                    {0.15, GoalKind::ResidualAtMost},
                                                    {250.0, GoalKind::TotalAtMost},
                                                    &TradeOff::residual_rms,
                                                    &TradeOff::total}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(WeightSearch, TwoTargetsThatCannotBothBeMetSaySo) {
  const auto result = search_weights(options_of({0.15, GoalKind::ResidualAtMost}, {100.0, GoalKind::TotalAtMost}),
                                     [](const Weights& w) { return std::optional(smooth_trade_off(w)); });
  EXPECT_FALSE(result.met());
  EXPECT_LE(result.trials.size(), 40u);
}

/// An L in log-log with its corner at log weight `corner`: steps fall along the one arm, the residual rises along the
/// other. `sharpness` large = a sharp corner.
TradeOff l_curve(double weight, double corner, double sharpness, double TradeOff::*cost) {
  const double u = std::log(weight / corner);
  TradeOff t{1.0, 1.0, 1.0};
  t.residual_rms = 0.1 * std::exp(std::log1p(std::exp(sharpness * u)) / sharpness);
  t.*cost = 0.01 * std::exp(std::log1p(std::exp(-sharpness * u)) / sharpness);
  return t;
}

/// The trial-free answer: the point of a dense sampling farthest from the chord between the ends, in log-log.
double farthest_from_chord(double from, double to, const std::function<TradeOff(double)>& curve,
                           double TradeOff::*cost) {
  const auto point = [&](double w) { return std::pair(std::log(curve(w).residual_rms), std::log(curve(w).*cost)); };
  const auto [x0, y0] = point(from);
  const auto [x1, y1] = point(to);
  double best = 0.0, farthest = from;
  for (int i = 1; i < 4000; ++i) {
    const double w = from * std::pow(to / from, i / 4000.0);
    const auto [x, y] = point(w);
    const double distance = -((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / std::hypot(x1 - x0, y1 - y0);
    if (distance > best) {
      best = distance;
      farthest = w;
    }
  }
  return farthest;
}

TEST(WeightSearch, TheCornerIsThePointFarthestFromTheChord) {
  for (const double sharpness : {0.5, 1.0, 4.0}) {
    for (const double corner : {0.01, 0.1, 0.5, 2.0}) {
      const auto curve = [&](double w) { return l_curve(w, corner, sharpness, &TradeOff::step_rms); };
      const auto result = search_weights(options_of({0.0, GoalKind::Corner}, kNoPrice),
                                         [&](const Weights& w) { return std::optional(curve(w.smoothness)); });
      const double expected =
          farthest_from_chord(kSmoothnessRange.corner_least, kSmoothnessRange.corner_most, curve, &TradeOff::step_rms);
      EXPECT_NEAR(std::log(chosen(result).weights.smoothness), std::log(expected), 0.25) << sharpness << " " << corner;
      EXPECT_TRUE(result.met());
      EXPECT_LE(result.trials.size(), 20u);
    }
  }
}

TEST(WeightSearch, TheCornerOfTheTimePriceIsFoundInItsOwnRange) {
  const double corner = 2e-3 * kPriceScale;
  const auto curve = [&](double w) { return l_curve(w, corner, 2.0, &TradeOff::total); };
  const WeightSearchOptions options = options_of(kSomeSmoothness, {0.0, GoalKind::Corner});
  const auto result = search_weights(options, [&](const Weights& w) { return std::optional(curve(w.time_price)); });
  const double expected = farthest_from_chord(options.time_price_range.corner_least,
                                              options.time_price_range.corner_most, curve, &TradeOff::total);
  EXPECT_NEAR(std::log(chosen(result).weights.time_price), std::log(expected), 0.25);
  EXPECT_EQ(chosen(result).weights.smoothness, 0.1);
}

TEST(WeightSearch, BothCornersTogether) {
  const auto evaluate = [](const Weights& w) {
    const TradeOff s = l_curve(w.smoothness, 0.2, 2.0, &TradeOff::step_rms);
    const TradeOff p = l_curve(w.time_price, 2e-3 * kPriceScale, 2.0, &TradeOff::total);
    return std::optional(TradeOff{s.residual_rms * p.residual_rms, p.total, s.step_rms});
  };
  const auto result = search_weights(options_of({0.0, GoalKind::Corner}, {0.0, GoalKind::Corner}), evaluate);
  EXPECT_LE(result.trials.size(), 40u);
  EXPECT_NEAR(std::log(chosen(result).weights.smoothness), std::log(0.2), 1.2);
  EXPECT_NEAR(std::log(chosen(result).weights.time_price), std::log(2e-3 * kPriceScale), 1.2);
  // No weight a factor of 3 away is better by the same measure.
  const TradeOff best = chosen(result).trade_off;
  EXPECT_LT(best.step_rms * best.residual_rms, 0.2 * evaluate({1e-3, 1e-5 * kPriceScale})->step_rms);
}

TEST(WeightSearch, ACornerUnderATargetMeetsTheTarget) {
  const auto result = search_weights(options_of({0.0, GoalKind::Corner}, {250.0, GoalKind::TotalAtMost}),
                                     [](const Weights& w) { return std::optional(smooth_trade_off(w)); });
  EXPECT_TRUE(result.met());
  EXPECT_LE(chosen(result).trade_off.total, 250.0);
  EXPECT_GE(chosen(result).trade_off.total, 0.9 * 250.0);
  EXPECT_GT(chosen(result).weights.smoothness, kSmoothnessRange.corner_least);
  EXPECT_LT(chosen(result).weights.smoothness, kSmoothnessRange.corner_most);
  EXPECT_LE(result.trials.size(), 40u);
}

TEST(WeightSearch, ACurveWithoutTradeOffGivesTheEndThatCostsNothing) {
  const auto no_gain = [](const Weights& w) { return std::optional(TradeOff{0.1 + w.smoothness, 1.0, 0.5}); };
  EXPECT_LE(chosen(search_weights(options_of({0.0, GoalKind::Corner}, kNoPrice), no_gain)).weights.smoothness, 2e-3);
  const auto no_loss = [](const Weights& w) { return std::optional(TradeOff{0.1, 1.0, 0.5 / (1.0 + w.smoothness)}); };
  EXPECT_GE(chosen(search_weights(options_of({0.0, GoalKind::Corner}, kNoPrice), no_loss)).weights.smoothness, 5.0);
}

TEST(WeightSearch, AZeroResidualOrStepIsNoFault) {
  const auto zero = [](const Weights&) { return std::optional(TradeOff{0.0, 0.0, 0.0}); };
  for (const GoalKind kind : {GoalKind::Corner, GoalKind::StepAtMost, GoalKind::ResidualAtMost}) {
    EXPECT_TRUE(search_weights(options_of({0.1, kind}, kNoPrice), zero).met());
  }
}

TEST(WeightSearch, IsDeterministicAndEvaluatesNoWeightTwice) {
  std::set<std::pair<double, double>> seen;
  const auto evaluate = [&](const Weights& w) {
    EXPECT_TRUE(seen.insert({w.smoothness, w.time_price}).second);
    return std::optional(smooth_trade_off(w));
  };
  const WeightSearchOptions options = options_of({0.0, GoalKind::Corner}, {250.0, GoalKind::TotalAtMost});
  const auto one = search_weights(options, evaluate);
  seen.clear();
  const auto two = search_weights(options, evaluate);
  ASSERT_EQ(one.trials.size(), two.trials.size());
  for (std::size_t k = 0; k < one.trials.size(); ++k) EXPECT_EQ(one.trials[k].weights, two.trials[k].weights);
  EXPECT_EQ(one.chosen, two.chosen);
}

TEST(WeightSearch, EndsWhereTheEvaluatorSaysSoAndChoosesAmongWhatThereIs) {
  for (const std::size_t most : {1u, 3u, 9u}) {
    std::size_t evaluated = 0;
    const auto result = search_weights(options_of({0.0, GoalKind::Corner}, {0.0, GoalKind::Corner}),
                                       [&](const Weights& w) -> std::optional<TradeOff> {
                                         if (evaluated == most) return std::nullopt;
                                         ++evaluated;
                                         return smooth_trade_off(w);
                                       });
    EXPECT_EQ(result.trials.size(), most);
    EXPECT_LT(result.chosen, most);
  }
}

TEST(WeightSearch, WhatTheEvaluatorThrowsArrives) {
  for (const std::size_t at : {0u, 2u, 8u}) {
    std::size_t evaluated = 0;
    const auto evaluate = [&](const Weights& w) {
      if (evaluated++ == at) throw std::runtime_error("stop at once");
      return std::optional(smooth_trade_off(w));
    };
    EXPECT_THROW(search_weights(options_of({0.0, GoalKind::Corner}, kNoPrice), evaluate), std::runtime_error) << at;
    evaluated = 0;
    if (at < 8) {
      EXPECT_THROW(search_weights(options_of({0.004, GoalKind::StepAtMost}, kNoPrice), evaluate), std::runtime_error);
    }
  }
}

TEST(WeightSearch, RefusesWhatMakesNoSense) {
  const auto evaluate = [](const Weights& w) { return std::optional(smooth_trade_off(w)); };
  EXPECT_THROW(search_weights(options_of(kSomeSmoothness, kNoPrice), evaluate), std::invalid_argument);
  WeightSearchOptions options = options_of({0.0, GoalKind::Corner}, kNoPrice);
  options.smoothness_range.least = std::nan("");
  EXPECT_THROW(search_weights(options, evaluate), std::invalid_argument);
  const auto nan = [](const Weights&) { return std::optional(TradeOff{std::nan(""), 1.0, 1.0}); };
  EXPECT_THROW(search_weights(options_of({0.0, GoalKind::Corner}, kNoPrice), nan), std::invalid_argument);
}

TEST(FewVariables, FindsTheMinimumOfAQuadraticAtTheEdgeOfItsBox) {
  FewVariableProblem problem;
  problem.start = {0.2, 0.8};
  problem.lower = {0.0, 0.0};
  problem.upper = {0.7, 1.0};
  problem.first_step = {0.25, 0.25};
  problem.max_evaluations = 100;
  std::vector<double> best;
  double least = 1e9;
  problem.evaluate = [&](const std::vector<double>& x, double& value) {
    value = (x[0] - 0.9) * (x[0] - 0.9) + (x[1] - 0.6) * (x[1] - 0.6);
    if (value < least) {
      least = value;
      best = x;
    }
    return true;
  };
  search_few_variables(problem);
  ASSERT_EQ(best.size(), 2u);
  EXPECT_NEAR(best[0], 0.7, 0.01);
  EXPECT_NEAR(best[1], 0.6, 0.01);
  problem.upper.pop_back();
  EXPECT_THROW(search_few_variables(problem), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
