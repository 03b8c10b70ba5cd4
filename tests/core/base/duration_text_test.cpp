#include "core/base/duration_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dwell {
namespace {

TEST(DurationText, AddsHoursFromTenMinutesOn) {
  EXPECT_EQ(duration_text(0.0), "0.00 s");
  EXPECT_EQ(duration_text(599.99), "599.99 s");
  EXPECT_EQ(duration_text(600.0), "600.00 s (0:10:00)");
  EXPECT_EQ(duration_text(7661.32), "7661.32 s (2:07:41)");
  EXPECT_EQ(duration_text(86399.6), "86399.60 s (1 d 0:00:00)");
  EXPECT_EQ(duration_text(4150923.0), "4150923.00 s (48 d 1:02:03)");
  EXPECT_EQ(duration_text(HUGE_VAL), "inf s");
  EXPECT_EQ(clock_text(59.6), "0:01:00");
  EXPECT_EQ(clock_text(0.2), "0:00:00");
  EXPECT_EQ(clock_text(7661.32), "2:07:41");
  EXPECT_EQ(clock_text(HUGE_VAL), "");
}

}  // namespace
}  // namespace dwell
