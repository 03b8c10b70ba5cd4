#include "paths/feed/look_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/paths/feed/motion_oracle.h"

namespace dwell {
namespace {

std::vector<Machine> machines() {
  Machine plain, blends, gentle;
  plain.path_acceleration = blends.path_acceleration = gentle.path_acceleration = 15.0;
  plain.corner = gentle.corner = CornerRule::JunctionDeviation;
  plain.junction_deviation = gentle.junction_deviation = 0.5;
  plain.max_feed = blends.max_feed = gentle.max_feed = 8.0;
  blends.corner = CornerRule::Blend;
  blends.blend_tolerance = 0.05;
  gentle.path_jerk = 200.0;
  return {plain, blends, gentle};
}

TEST(LookAhead, KeepsTheSpeedsOfAllPassesWhileFeedsChange) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Machine& machine : machines()) {
    const KinematicPath path = kinematic_path(test::crooked_chain(9, 200, 1.0, 8.0), machine);
    const std::vector<std::size_t> begins{0, 3, 4, 40, 41, 90, 130, 199};
    LookAhead ahead(path, begins);
    const auto set = [&](std::size_t move, double feed) {
      const auto after = std::upper_bound(begins.begin(), begins.end(), move);
      ahead.set_feed(static_cast<std::size_t>(after - begins.begin()) - 1, move, feed);
    };
    std::size_t untouched = 0, unchanged = 0;
    for (int round = 0; round < 60; ++round) {
      const std::vector<double> before = ahead.squared();
      for (int k = 0; k < 1 + round % 4; ++k) set(static_cast<std::size_t>(200.0 * unit(random)), 8.0 * unit(random));
      if (round % 7 == 0) set(40, 8.0 * unit(random)), set(3, 8.0 * unit(random));  // where blocks begin
      ahead.update();
      EXPECT_EQ(ahead.squared(), node_speeds_squared(path, ahead.feeds())) << round;
      for (std::size_t b = 0; b < ahead.blocks(); ++b) {
        untouched += ahead.touched(b) ? 0U : 1U;
        for (std::size_t node = ahead.begin_of(b); node < ahead.end_of(b); ++node) {
          if (!ahead.touched(b) || !ahead.changed(node)) {
            EXPECT_EQ(ahead.squared()[node], before[node]) << round << ' ' << node;
            ++unchanged;
          }
        }
      }
    }
    EXPECT_GT(untouched, 100U);
    EXPECT_GT(unchanged, 5000U);
  }
}

}  // namespace
}  // namespace dwell
