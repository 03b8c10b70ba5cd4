#include "paths/domain/box_mean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

TEST(BoxMean, AgreesWithADoubleLoop) {
  std::mt19937_64 random(3);
  HeightMap map(Grid{23, 37, 0.3, 0.5, {1.0, -2.0}});
  for (double& z : map.values) z = random() % 5 == 0 ? test::kNaN : static_cast<double>(random() % 1000);
  for (const double side : {0.0, 0.5, 0.6, 1.0, 3.1, 8.0, 1e9}) {
    const HeightMap mean = box_mean(map, side);
    ASSERT_EQ(mean.grid, map.grid);
    for (Index row = 0; row < map.grid.rows; ++row) {
      for (Index col = 0; col < map.grid.cols; ++col) {
        double sum = 0.0, count = 0.0;
        for (Index r = 0; r < map.grid.rows; ++r) {
          for (Index c = 0; c < map.grid.cols; ++c) {
            if (std::abs(static_cast<double>(c - col)) * 0.3 > 0.5 * side + 1e-12) continue;
            if (std::abs(static_cast<double>(r - row)) * 0.5 > 0.5 * side + 1e-12) continue;
            if (!std::isfinite(map.at(r, c))) continue;
            sum += map.at(r, c);
            count += 1.0;
          }
        }
        if (std::isfinite(map.at(row, col))) {
          EXPECT_NEAR(mean.at(row, col), sum / count, 1e-10) << side;
        } else {
          EXPECT_TRUE(std::isnan(mean.at(row, col)));
        }
      }
    }
  }
}

TEST(BoxMean, RefusesASideThatIsNone) {
  const HeightMap map = test::full_map(2, 3);
  EXPECT_EQ(test::message_of([&] { box_mean(map, -1.0); }), "box mean: side = -1 mm; required finite and >= 0");
  EXPECT_EQ(test::message_of([&] { box_mean(map, test::kNaN); }), "box mean: side = nan mm; required finite and >= 0");
}

}  // namespace
}  // namespace dwell
