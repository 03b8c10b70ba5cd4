#include "solvers/weights/weight_option.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

WeightGoal smoothness(const std::string& text) { return parse_weight_goal(text, kSmoothnessTarget); }
WeightGoal price(const std::string& text) { return parse_weight_goal(text, kTimePriceTarget); }

TEST(WeightOption, ReadsNumbersAutoAndTargets) {
  EXPECT_EQ(smoothness("0.1"), (WeightGoal{0.1, GoalKind::Fixed}));
  EXPECT_EQ(smoothness("0"), (WeightGoal{0.0, GoalKind::Fixed}));
  EXPECT_EQ(smoothness("auto"), (WeightGoal{0.0, GoalKind::Auto}));
  EXPECT_EQ(smoothness("corner"), (WeightGoal{0.0, GoalKind::Corner}));
  EXPECT_EQ(smoothness("step<=0.004"), (WeightGoal{0.004, GoalKind::StepAtMost}));
  EXPECT_EQ(smoothness("residual<=0.155"), (WeightGoal{0.155, GoalKind::ResidualAtMost}));
  EXPECT_EQ(price("1e-7"), (WeightGoal{1e-7, GoalKind::Fixed}));
  EXPECT_EQ(price("auto"), (WeightGoal{0.0, GoalKind::Auto}));
  EXPECT_EQ(price("corner"), (WeightGoal{0.0, GoalKind::Corner}));
  EXPECT_EQ(price("total<=425"), (WeightGoal{425.0, GoalKind::TotalAtMost}));
  EXPECT_EQ(price("residual<=0.15"), (WeightGoal{0.15, GoalKind::ResidualAtMost}));
}

TEST(WeightOption, IsFreeInBlanksCaseUnitsAndTheWordRms) {
  for (const char* text : {"step <= 0.004", "step<=0.004s", " Step RMS <= 4e-3 s ", "stepRMS<=0.004 s"}) {
    EXPECT_EQ(smoothness(text), (WeightGoal{0.004, GoalKind::StepAtMost})) << text;
  }
  for (const char* text : {"residual<=0.15nm", "RESIDUAL RMS <= 0.15 nm"}) {
    EXPECT_EQ(price(text), (WeightGoal{0.15, GoalKind::ResidualAtMost})) << text;
  }
  EXPECT_EQ(price("total <= 425 s"), (WeightGoal{425.0, GoalKind::TotalAtMost}));
  EXPECT_EQ(price(" AUTO"), (WeightGoal{0.0, GoalKind::Auto}));
}

TEST(WeightOption, TextReadsBackEqual) {
  for (const WeightGoal& goal :
       {WeightGoal{1.0 / 3.0, GoalKind::Fixed}, WeightGoal{0.0, GoalKind::Auto}, WeightGoal{0.0, GoalKind::Corner},
        WeightGoal{1.0 / 7.0, GoalKind::StepAtMost}, WeightGoal{1e-9, GoalKind::ResidualAtMost}}) {
    EXPECT_EQ(smoothness(to_string(goal)), goal) << to_string(goal);
  }
  const WeightGoal total{1e7 / 3.0, GoalKind::TotalAtMost};
  EXPECT_EQ(price(to_string(total)), total);
}

TEST(WeightOption, RefusesTheRestNamingTheTextAndWhatIsAccepted) {
  for (const char* text : {"-1",
                           "nan",
                           "inf",
                           "automatic",
                           "step",
                           "step<=",
                           "step<=0",
                           "step<=-1",
                           "step<=nan",
                           "step<=inf",
                           "step<0.1",
                           "step>=0.1",
                           "step<=0.1nm",
                           "step<=0.1 ms",
                           "total<=3",
                           "<=3",
                           "residual<=0.1s",
                           "residual<=0",
                           "RMS<=1",
                           "step<=1<=2",
                           "step residual<=1",
                           "0.1 s"}) {
    expect_input_error([&] { smoothness(text); }, {"'" + std::string(text) + "'", "a number from 0 to", "auto",
                                                   "corner", "'step<=S'", "'residual<=NM'", "in s", "in nm"});
  }
  expect_input_error([] { price("step<=1"); }, {"'step<=1'", "'total<=S'", "'residual<=NM'"});
}

}  // namespace
}  // namespace dwell
