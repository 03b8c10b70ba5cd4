#include "core/anatomy/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dwell {
namespace {

/// Beside a strip that is lost, the pairs are those along row and column, which lie farther away than any all round:
/// none of them may be taken from where a row goes on in memory, at the other edge of the map.
TEST(Surroundings, DoNotReachRoundTheEdgeOfTheMap) {
  const Grid grid{70, 90, 0.2, 0.3, {-4.0, 3.0}};
  HeightMap map(grid), other(grid);
  for (Index i = 0; i < grid.size(); ++i) {
    const Index col = i % grid.cols;
    const bool lost = col >= 50 && col < 62;
    const double height = lost ? std::numeric_limits<double>::quiet_NaN() : std::sin(1.7 * static_cast<double>(i));
    map.values[static_cast<std::size_t>(i)] = height;
    other.values[static_cast<std::size_t>(i)] = col < 20 ? height + 1000.0 : height;
  }
  const Surroundings here(map, 3.6), there(other, 3.6);
  int seen = 0;
  for (const Index row : {20, 27, 35, 44}) {
    for (const Index col : {64, 66, 68, 70}) {
      const auto a = here.deviation(row, col), b = there.deviation(row, col);
      ASSERT_EQ(a.has_value(), b.has_value()) << row << ' ' << col;
      seen += a.has_value();
      EXPECT_EQ(a ? a->middle : 0.0, b ? b->middle : 0.0) << row << ' ' << col;
      EXPECT_EQ(a ? a->sigma : 0.0, b ? b->sigma : 0.0) << row << ' ' << col;
    }
  }
  EXPECT_GT(seen, 8);
}

}  // namespace
}  // namespace dwell
