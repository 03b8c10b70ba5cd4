#include "runs/plan/weight_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dwell {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

WeightSearchOptions step_and_residual() {
  WeightSearchOptions how;
  how.smoothness = {0.02, GoalKind::StepAtMost};
  how.time_price = {1.5, GoalKind::ResidualAtMost};
  how.time_price_range = time_price_range(4.0);
  return how;
}

/// Residual [nm], total [s], step [s] of trials with the weights (1, 0), (2, 0), ...
WeightTrials trials_of(const std::vector<TradeOff>& trade_offs, std::size_t chosen) {
  WeightTrials search;
  for (const TradeOff& t : trade_offs) {
    search.trials.push_back({{static_cast<double>(search.trials.size() + 1), 0.0}, t, 0.0, 1});
  }
  search.chosen = chosen;
  return search;
}

TEST(WeightVerdict, AConflictTakesTwoTargetsThatAreEachMet) {
  WeightTrials search = trials_of({{1.304, 300.0, 0.031}, {1.77, 290.0, 0.022}, {3.0, 280.0, 0.019}}, 1);
  judge_search(step_and_residual(), SearchEnd::Missed, search);
  EXPECT_EQ(search.outcome, "conflict");
  ASSERT_EQ(search.limits.size(), 1u);
  EXPECT_THAT(search.limits[0],
              AllOf(HasSubstr("`smoothness` 'step<=0.02' and `time price` 'residual<=1.5' are in conflict"),
                    HasSubstr("3 solves, smoothness from 1 to 3, time price from 0 to 0 nm^2/s"),
                    HasSubstr("at most 1.18 times a target: step RMS 0.022 s, residual RMS 1.77 nm (smoothness 2, ")));
}

TEST(WeightVerdict, ATargetThatNoTrialMeetsIsNamedAloneWithTheTrialNearestToIt) {
  WeightTrials search = trials_of({{1.6, 300.0, 0.015}, {1.77, 290.0, 0.0205}, {3.0, 280.0, 0.019}}, 0);
  judge_search(step_and_residual(), SearchEnd::Missed, search);
  EXPECT_EQ(search.outcome, "missed");
  ASSERT_EQ(search.limits.size(), 1u);
  EXPECT_THAT(search.limits[0], AllOf(HasSubstr("`time price` 'residual<=1.5' is not met: 3 weights tried"),
                                      HasSubstr("the nearest has residual RMS 1.6 nm (smoothness 1, "),
                                      Not(HasSubstr("conflict")), HasSubstr("the plan is the nearest of the solves")));
}

TEST(WeightVerdict, ASearchThatWasCutShortClaimsNothing) {
  WeightTrials search = trials_of({{1.304, 300.0, 0.031}, {3.0, 280.0, 0.019}}, 1);
  judge_search(step_and_residual(), SearchEnd::Unfinished, search);
  EXPECT_EQ(search.outcome, "unfinished");
  ASSERT_EQ(search.limits.size(), 1u);
  EXPECT_THAT(search.limits[0], AllOf(HasSubstr("whether some weights meet both is open"), Not(HasSubstr("conflict"))));
}

TEST(WeightVerdict, ASingleTargetNamesTheNearestTrial) {
  WeightSearchOptions how = step_and_residual();
  how.time_price = {};
  WeightTrials search = trials_of({{1.0, 300.0, 0.031}, {2.0, 290.0, 0.03}}, 1);
  judge_search(how, SearchEnd::Missed, search);
  ASSERT_EQ(search.limits.size(), 1u);
  EXPECT_THAT(search.limits[0], HasSubstr("`smoothness` 'step<=0.02' is not met: 2 weights tried, smoothness from 1 to "
                                          "2; the nearest has step RMS 0.03 s (smoothness 2, time price 0 nm^2/s)"));
  search.limits.clear();
  judge_search(how, SearchEnd::Met, search);
  EXPECT_EQ(search.outcome, "met");
  EXPECT_TRUE(search.limits.empty());
}

TEST(WeightVerdict, TheCriterionOfTwoTargetsSaysWhatIsLeast) {
  EXPECT_THAT(search_criterion(step_and_residual()),
              HasSubstr("the least total dwell with step RMS <= 0.02 s and residual RMS <= 1.5 nm"));
  WeightSearchOptions how = step_and_residual();
  how.time_price = {300.0, GoalKind::TotalAtMost};
  EXPECT_THAT(search_criterion(how), HasSubstr("the least residual RMS with step RMS"));
  how.smoothness = {1.0, GoalKind::ResidualAtMost};
  EXPECT_THAT(search_criterion(how), HasSubstr("the least step RMS with residual RMS"));
}

}  // namespace
}  // namespace dwell
