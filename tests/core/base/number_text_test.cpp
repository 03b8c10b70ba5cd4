#include "core/base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dwell {
namespace {

TEST(ParseNumber, ReadsWholeNumbersOnly) {
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number(" -2e-3\r"), -2e-3);
  EXPECT_EQ(parse_number("+7"), 7.0);
  for (const char* text : {"", " ", "+", "-", "1,5", "1.5x", "1 2", "0x10", "++1", "+-1", "1e999", "mm"}) {
    EXPECT_FALSE(parse_number(text).has_value()) << text;
  }
}

TEST(ParseNumber, LeavesInfinityAndNanToTheCaller) {
  EXPECT_EQ(parse_number("inf"), HUGE_VAL);
  ASSERT_TRUE(parse_number("nan").has_value());
  EXPECT_TRUE(std::isnan(*parse_number("nan")));
}

TEST(ParseNumber, KnowsWhatProgramsWriteForNoData) {
  for (const char* text : {"", "nan", "-nan", "nan(ind)", "NA", "None", "NULL", "masked", "--", "BAD", "1.#QNAN",
                           "-1.#IND", "\"none\"", "<NA>", "NoData", "#N/A"}) {
    const auto value = height_number(text);
    ASSERT_TRUE(value) << text;
    EXPECT_TRUE(std::isnan(*value)) << text;
  }
  for (const char* text : {"1.#INF", "#REF!", "-", "nothing", "bads"}) EXPECT_FALSE(height_number(text)) << text;
}

TEST(FewestDigits, UndoWhatAChangeOfUnitsMakesOfANumber) {
  EXPECT_EQ(fewest_digits(3e-6 * 1e3), 0.003);
  EXPECT_EQ(fewest_digits(849.3000000000001), 849.3);
  EXPECT_EQ(fewest_digits(-0.1 - 0.2), -0.3);
  EXPECT_EQ(fewest_digits(0.0), 0.0);
  // What is meant to have many digits keeps them.
  EXPECT_EQ(fewest_digits(1.0 / 3.0), 1.0 / 3.0);
  EXPECT_EQ(fewest_digits(1.0000000000004), 1.0);
  EXPECT_EQ(fewest_digits(1.00000000001), 1.00000000001);
  EXPECT_EQ(fewest_digits(HUGE_VAL), HUGE_VAL);
}

TEST(ToldApart, ShowsAsManyDigitsAsTakeTwoNumbersApart) {
  using Two = std::pair<std::string, std::string>;
  EXPECT_EQ(told_apart(18.2, 18.07), (Two{"18.2", "18.07"}));
  EXPECT_EQ(told_apart(18.070012, 18.070009), (Two{"18.070012", "18.070009"}));
  EXPECT_EQ(told_apart(2.0, 2.0), (Two{"2", "2"}));
}

TEST(ParseNumber, TrimsBothEnds) {
  EXPECT_EQ(trim("\t a b \r"), "a b");
  EXPECT_EQ(trim(" \t"), "");
}

}  // namespace
}  // namespace dwell
