#include "runs/drawing/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "runs/drawing/sheet.h"

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
        const AxisTicks ticks = round_ticks(lower, lower + width, most);
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
  const AxisTicks ticks = round_ticks(1e9, std::nextafter(1e9, 2e9), 5);
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

TEST(LogTicks, AreOneTwoFiveOrDecadesOrRoundNumbersOfANarrowRange) {
  EXPECT_EQ(log_ticks(0.15, 2.5, 7).labels, (std::vector<std::string>{"0.2", "0.5", "1", "2"}));
  EXPECT_EQ(log_ticks(0.001, 1000.0, 7).labels,
            (std::vector<std::string>{"0.001", "0.01", "0.1", "1", "10", "100", "1000"}));
  EXPECT_EQ(log_ticks(355.0, 440.0, 5).labels, (std::vector<std::string>{"360", "380", "400", "420", "440"}));
  const AxisTicks narrow = log_ticks(1.0, 1.0 + 1e-6, 7);
  for (const double v : narrow.values) EXPECT_TRUE(v >= 1.0 && v <= 1.0 + 1e-6) << v;
}

TEST(LogTicks, LieWithinAnyRange) {
  for (int i = -60; i <= 60; ++i) {
    for (const double ratio : {1.001, 1.5, 2.1, 7.0, 1e3, 1e9}) {
      const double lower = std::pow(10.0, 0.17 * i), upper = lower * ratio;
      const AxisTicks ticks = log_ticks(lower, upper, 7);
      EXPECT_GE(ticks.values.size(), 1u);
      EXPECT_EQ(ticks.values.size(), ticks.labels.size());
      for (const double v : ticks.values) EXPECT_TRUE(v >= lower * (1 - 1e-9) && v <= upper * (1 + 1e-9)) << v;
    }
  }
}

TEST(LogTicks, RefuseWhatIsNoRange) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const auto& [lower, upper] :
       {std::pair{0.0, 1.0}, {-1.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}, {1.0, inf}, {nan, 1.0}}) {
    EXPECT_THROW(log_ticks(lower, upper, 7), std::invalid_argument) << lower << " " << upper;
  }
  EXPECT_THROW(log_ticks(1.0, 2.0, 2), std::invalid_argument);
}

TEST(AxisRange, HasAsManyTicksAsTheirLabelsHaveRoomFor) {
  const AxisRange range{AxisScale::Linear, -1234.5, 987.6};
  const TextStyle style{13.0};
  for (const double length : {20.0, 60.0, 150.0, 500.0}) {
    const AxisTicks ticks = range.ticks(length, AxisDirection::Across, style);
    ASSERT_GE(ticks.values.size(), 1u);
    for (std::size_t i = 1; i < ticks.values.size(); ++i) {
      const double gap = length * (range.share(ticks.values[i]) - range.share(ticks.values[i - 1]));
      const double half =
          0.5 * (Sheet::text_width(ticks.labels[i], style) + Sheet::text_width(ticks.labels[i - 1], style));
      EXPECT_GT(gap, half) << length;
    }
  }
  EXPECT_GT(range.ticks(500.0, AxisDirection::Across, style).values.size(),
            range.ticks(150.0, AxisDirection::Across, style).values.size());
}

TEST(AxisRange, SharesAreOfTheRangeOrOfItsLogarithm) {
  const AxisRange linear{AxisScale::Linear, -10.0, 10.0}, logarithmic{AxisScale::Logarithmic, 0.01, 100.0};
  EXPECT_DOUBLE_EQ(linear.share(5.0), 0.75);
  EXPECT_DOUBLE_EQ(logarithmic.share(1.0), 0.5);
  for (const AxisRange& range : {linear, logarithmic}) {
    EXPECT_EQ(range.share(-1e9), 0.0);
    EXPECT_EQ(range.share(1e9), 1.0);
    EXPECT_EQ(range.share(std::nan("")), 0.0);
  }
  EXPECT_TRUE(linear.holds(-1.0));
  EXPECT_FALSE(logarithmic.holds(-1.0));
}

}  // namespace
}  // namespace dwell
