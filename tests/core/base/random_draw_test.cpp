#include "core/base/random_draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace dwell {
namespace {

TEST(RandomDraw, IsTheShuffleOfAWholeListFromTheFront) {
  constexpr Index n = 1000;
  std::vector<Index> list(n);
  std::iota(list.begin(), list.end(), Index{0});
  RandomNumbers random(5);
  RandomDraw draw(n, 5);
  for (Index k = 0; k < n; ++k) {
    const Index other = k + random.below(static_cast<std::uint32_t>(n - k));
    std::swap(list[static_cast<std::size_t>(k)], list[static_cast<std::size_t>(other)]);
    EXPECT_EQ(draw.left(), n - k);
    EXPECT_EQ(draw.next(), list[static_cast<std::size_t>(k)]) << k;
  }
  EXPECT_EQ(draw.left(), 0);
  std::sort(list.begin(), list.end());
  for (Index k = 0; k < n; ++k) EXPECT_EQ(list[static_cast<std::size_t>(k)], k);
}

// The square of 24 orders has 23 degrees of freedom: it is above 60 once in 30,000 times.
TEST(RandomDraw, TakesEveryOrderEquallyOften) {
  std::array<int, 256> seen{};
  for (std::uint64_t trial = 0; trial < 24000; ++trial) {
    RandomDraw draw(4, trial);
    Index code = 0;
    for (int k = 0; k < 4; ++k) code = 4 * code + draw.next();
    ++seen.at(static_cast<std::size_t>(code));
  }
  double chi_squared = 0.0;
  for (const int count : seen) chi_squared += count == 0 ? 0.0 : (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_EQ(std::count_if(seen.begin(), seen.end(), [](int count) { return count > 0; }), 24);
  EXPECT_LT(chi_squared, 60.0);
}

}  // namespace
}  // namespace dwell
