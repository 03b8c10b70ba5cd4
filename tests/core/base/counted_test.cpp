#include "core/base/counted.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace dwell {
namespace {

TEST(Counted, SaysOneInTheSingular) {
  EXPECT_EQ(counted(0, "pixel"), "0 pixels");
  EXPECT_EQ(counted(std::size_t{1}, "pixel"), "1 pixel");
  EXPECT_EQ(counted(-1, "step"), "-1 steps");
  EXPECT_EQ(counted(1234567L, "dwell point"), "1234567 dwell points");
  EXPECT_EQ(counted(1, "match", "matches"), "1 match");
  EXPECT_EQ(counted(2, "match", "matches"), "2 matches");
}

}  // namespace
}  // namespace dwell
