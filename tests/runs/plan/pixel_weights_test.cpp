#include "runs/plan/pixel_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dwell {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// 16 x 12 mm of pixels longer along y, with a missing corner, a bore of 3 x 2 mm and a lost pixel.
HeightMap holed_part() {
  HeightMap map(Grid{24, 40, 0.4, 0.5, {-2.0, 3.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Index row = i / map.grid.cols, col = i % map.grid.cols;
    const bool missing = row + col < 5 || (row >= 10 && row < 14 && col >= 20 && col < 28) || (row == 18 && col == 10);
    map.values[static_cast<std::size_t>(i)] = missing ? kNone : 1.0;
  }
  return map;
}

// The distance to every place without data, by brute force; pixels beyond the map have none either.
TEST(PixelWeights, AtTheEdgeHoldWithinTheWidth) {
  const HeightMap part = holed_part();
  const Grid& g = part.grid;
  const double width = 0.9;
  const std::vector<double> weights = weights_at_edge(part, width, 0.25);
  int inside = 0, at_edge = 0;
  for (Index i = 0; i < g.size(); ++i) {
    if (std::isnan(part.values[static_cast<std::size_t>(i)])) continue;
    double nearest = 1e9;
    for (Index row = -1; row <= g.rows; ++row) {
      for (Index col = -1; col <= g.cols; ++col) {
        const bool on_map = row >= 0 && row < g.rows && col >= 0 && col < g.cols;
        const bool lost = row == 18 && col == 10;  // a hole narrower than twice the width is no edge
        if (on_map && (lost || !std::isnan(part.at(row, col)))) continue;
        nearest = std::min(nearest, distance(g.centre(i), g.centre(row, col)));
      }
    }
    // Whether the distance is to the centre of the missing pixel or to its border is within a pixel of the width.
    const double weight = weights[static_cast<std::size_t>(i)];
    if (nearest <= width) {
      EXPECT_EQ(weight, 0.25) << i;
    } else if (nearest > width + 0.5) {
      EXPECT_EQ(weight, 1.0) << i;
    }
    (weights[static_cast<std::size_t>(i)] == 1.0 ? inside : at_edge) += 1;
  }
  EXPECT_GT(inside, 300);
  EXPECT_GT(at_edge, 150);
}

TEST(PixelWeights, InTheCentreFallToOneAtTheBorder) {
  HeightMap part = holed_part();
  const std::vector<double> weights = weights_in_centre(part, 3.0);
  const Grid& g = part.grid;
  const Point middle{0.5 * (g.x(0) + g.x(g.cols - 1)), 0.5 * (g.y(0) + g.y(g.rows - 1))};
  for (Index i = 0; i < g.size(); ++i) {
    const Point p = g.centre(i) - middle;
    const double rho = std::hypot(p.x / 8.0, p.y / 6.0);
    const double expected = rho >= 1.0 ? 1.0 : 1.0 + 2.0 * std::pow(std::cos(0.5 * std::numbers::pi * rho), 2);
    EXPECT_NEAR(weights[static_cast<std::size_t>(i)], expected, 1e-12) << i;
  }
  // The box is that of the pixels with data.
  for (Index row = 0; row < g.rows; ++row) part.at(row, g.cols - 1) = part.at(row, g.cols - 2) = kNone;
  const std::vector<double> moved = weights_in_centre(part, 0.0);
  EXPECT_NEAR(moved[static_cast<std::size_t>(g.index(11, 18))],
              1.0 - std::pow(std::cos(0.5 * std::numbers::pi * std::hypot(0.2 / 7.6, 0.25 / 6.0)), 2), 1e-12);
  EXPECT_EQ(moved[static_cast<std::size_t>(g.index(11, 39))], 1.0);
}

}  // namespace
}  // namespace dwell
