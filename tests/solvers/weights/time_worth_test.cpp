#include "solvers/weights/time_worth.h"

#include <gtest/gtest.h>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

TEST(TimeWorth, IsTheSmallerOfTwoPrices) {
  const LeftAndTotal least{100.0, 50.0};
  // Share: 0.3 * 20 / 250 = 0.024; average: 0.1 * (100 - 20) / (250 - 50) = 0.04.
  const RuledPrice share = worth_of_time({}, least, {20.0, 250.0});
  EXPECT_DOUBLE_EQ(share.price, 0.024);
  EXPECT_EQ(share.rule, PriceRule::Share);
  // Share: 0.3 * 80 / 250 = 0.096; average: 0.1 * (100 - 80) / 200 = 0.01.
  const RuledPrice average = worth_of_time({}, least, {80.0, 250.0});
  EXPECT_DOUBLE_EQ(average.price, 0.01);
  EXPECT_EQ(average.rule, PriceRule::Average);
  EXPECT_DOUBLE_EQ(worth_of_time({0.1, 0.1}, least, {20.0, 250.0}).price, 0.008);
  EXPECT_DOUBLE_EQ(worth_of_time({0.3, 0.01}, least, {20.0, 250.0}).price, 0.004);
}

TEST(TimeWorth, SaysNothingByTheAverageWhereNothingIsTakenOrGained) {
  for (const LeftAndTotal& plan : {LeftAndTotal{100.0, 50.0}, LeftAndTotal{120.0, 60.0}}) {
    const RuledPrice ruled = worth_of_time({}, {100.0, 50.0}, plan);
    EXPECT_EQ(ruled.rule, PriceRule::Share);
    EXPECT_DOUBLE_EQ(ruled.price, 0.3 * plan.half_mean_square / plan.total);
  }
  EXPECT_EQ(worth_of_time({}, {0.0, 0.0}, {0.0, 0.0}).price, 0.0);
}

TEST(TimeWorth, IsReadAndReadBack) {
  EXPECT_EQ(parse_time_worth("0.5"), (TimeWorth{0.5, 0.1}));
  EXPECT_EQ(parse_time_worth(" 0.25 , 0.125 "), (TimeWorth{0.25, 0.125}));
  const TimeWorth odd{1.0 / 3.0, 1.0 / 7.0};
  EXPECT_EQ(parse_time_worth(to_string(odd)), odd);
  for (const std::string text : {"", "0", "-1", "nan", "0.3,", "0.3,0", "0.3,0.1,2", "0,3;1", "2e3", "0.3 %"}) {
    test::expect_input_error([&] { parse_time_worth(text); }, {"'" + text + "'", "K,MU", "from 1e-06 to 1000"});
  }
}

}  // namespace
}  // namespace dwell
