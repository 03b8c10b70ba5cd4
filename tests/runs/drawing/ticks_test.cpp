#include "runs/drawing/ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace dwell {
namespace {

using Labels = std::vector<std::string>;

TEST(RoundTicks, TakesTheSmallestRoundStepThatFits) {
  EXPECT_EQ(round_ticks(0.0, 92.4, 5).labels, (Labels{"0", "20", "40", "60", "80"}));
  EXPECT_EQ(round_ticks(0.0, 92.4, 10).labels, (Labels{"0", "10", "20", "30", "40", "50", "60", "70", "80", "90"}));
  EXPECT_EQ(round_ticks(-19.3, 19.3, 8).labels, (Labels{"-15", "-10", "-5", "0", "5", "10", "15"}));
}

TEST(RoundTicks, KeepsEndsThatAreMultiples) {
  EXPECT_EQ(round_ticks(0.1, 0.5, 5).labels, (Labels{"0.1", "0.2", "0.3", "0.4", "0.5"}));
  EXPECT_EQ(round_ticks(-0.3, 0.3, 3).labels, (Labels{"-0.2", "0", "0.2"}));
}

TEST(RoundTicks, PrintsTheDecimalsOfTheStep) {
  EXPECT_EQ(round_ticks(0.97, 1.07, 4).labels, (Labels{"1.00", "1.05"}));
  EXPECT_EQ(round_ticks(2e-5, 6e-5, 3).labels, (Labels{"2e-05", "4e-05", "6e-05"}));
  EXPECT_EQ(round_ticks(0.0, 3e6, 4).labels, (Labels{"0", "1e+06", "2e+06", "3e+06"}));
}

TEST(RoundTicks, LiesInTheRangeAscendingAndNoMoreThanAsked) {
  for (const double lower : {-1234.5, -0.007, 0.0, 3.3e4}) {
    for (const double width : {1e-3, 0.9, 7.7, 5e5}) {
      for (int most = 1; most <= 10; ++most) {
        const Ticks ticks = round_ticks(lower, lower + width, most);
        ASSERT_GE(ticks.values.size(), 1U);
        ASSERT_LE(ticks.values.size(), static_cast<std::size_t>(most));
        ASSERT_EQ(ticks.labels.size(), ticks.values.size());
        for (std::size_t i = 0; i < ticks.values.size(); ++i) {
          EXPECT_GE(ticks.values[i], lower - 1e-6 * width);
          EXPECT_LE(ticks.values[i], lower + width + 1e-6 * width);
          EXPECT_LE(std::abs(std::stod(ticks.labels[i]) - ticks.values[i]), 1e-9 * std::abs(ticks.values[i]));
          if (i == 0) continue;
          EXPECT_GT(ticks.values[i], ticks.values[i - 1]);
        }
        // A round step is at most 2.5 times the next finer one, so that the count never falls far below the limit.
        EXPECT_GE(5 * static_cast<int>(ticks.values.size()), most);
      }
    }
  }
}

TEST(RoundTicks, SurvivesARangeNarrowerThanItsRounding) {
  const Ticks ticks = round_ticks(1e9, std::nextafter(1e9, 2e9), 5);
  ASSERT_EQ(ticks.values.size(), 1U);
  EXPECT_EQ(ticks.values[0], 1e9);
}

TEST(RoundTicks, RejectsWhatIsNoRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(round_ticks(1.0, 1.0, 5), std::invalid_argument);
  EXPECT_THROW(round_ticks(nan, 1.0, 5), std::invalid_argument);
  EXPECT_THROW(round_ticks(0.0, std::numeric_limits<double>::infinity(), 5), std::invalid_argument);
  EXPECT_THROW(round_ticks(0.0, 1.0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
