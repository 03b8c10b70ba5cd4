#include "core/base/grid_limit.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/memory.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

TEST(GridLimit, Takes16384SquareUnlessTheUserSaysOtherwise) {
  EXPECT_EQ(limited_grid(16384, 16384, {1, 1}, {}, "map a").size(), Index{16384} * 16384);
  EXPECT_NO_THROW(check_pixels(2, 3, {6.0}, "map a"));
  EXPECT_NO_THROW(check_pixels(20000, 20000, {4e8}, "map a"));
  const auto refused = [](double rows, double cols, const PixelLimit& limit, const std::string& most) {
    test::expect_input_error([&] { check_pixels(rows, cols, limit, "map a"); },
                             {"map a: a map of", "from 1 to " + most + " pixels", "`max pixels`"});
  };
  refused(16384, 16385, {}, "268435456");
  refused(2, 3, {5.0}, "5");
  refused(0, 3, {}, "268435456");
  refused(std::numeric_limits<double>::quiet_NaN(), 3, {}, "268435456");
  refused(std::numeric_limits<double>::infinity(), 3, {}, "268435456");
}

TEST(GridLimit, AsksForMemoryBeforeItIsTaken) {
  const PixelLimit many{kMostPixelsOfAll};
  try {
    // 16 GiB: asked of a machine that is known to have less only where it has.
    limited_grid(46340, 46340, {0.1, 0.1}, {}, "pitch = 0.1 mm", many);
    EXPECT_GE(memory_to_be_had(), std::size_t{8} * 46340 * 46340 * 9 / 10);
  } catch (const OutOfMemory& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("pitch = 0.1 mm: a map of 46340 x 46340 pixels takes at least 16.00 GiB"), std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace dwell
