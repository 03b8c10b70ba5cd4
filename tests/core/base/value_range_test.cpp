#include "core/base/value_range.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

TEST(ValueRange, HoldsItsEndsAndNoNaN) {
  constexpr ValueRange kRange{-1.0, 2.5, "mm"};
  EXPECT_TRUE(kRange.holds(-1.0));
  EXPECT_TRUE(kRange.holds(2.5));
  EXPECT_FALSE(kRange.holds(2.5000001));
  EXPECT_FALSE(kRange.holds(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(kRange.holds(std::numeric_limits<double>::infinity()));
}

TEST(ValueRange, IsSaidWithItsUnit) {
  EXPECT_EQ((ValueRange{0.5, 3.0, "s"}.text()), "a number from 0.5 to 3 (s)");
  EXPECT_EQ((ValueRange{0.5, 3.0, ""}.text()), "a number from 0.5 to 3");
  EXPECT_NO_THROW(check_range("feed", 3.0, {0.5, 3.0, "mm/s"}));
  test::expect_input_error(
      [] {
        check_range("feed", 4.0, {0.5, 3.0, "mm/s"});
      },
      {"`feed` = 4 mm/s; required a number from 0.5 to 3 (mm/s)"});
}

}  // namespace
}  // namespace dwell
