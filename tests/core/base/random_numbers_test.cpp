#include "core/base/random_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace dwell {
namespace {

TEST(RandomNumbers, AreThoseOfTheStandardEngine) {
  // The standard says that the 10000th value of a default-seeded mt19937_64 is 9981545732273789042.
  RandomNumbers random(5489U);
  for (int i = 1; i < 10000; ++i) random.uniform();
  EXPECT_EQ(random.uniform(), static_cast<double>(9981545732273789042ULL >> 11U) * 0x1p-53);
}

// Every value comes to every place about equally often: the chi-squared of 24 orders has 23 degrees of freedom, of
// which the square is above 60 once in 30,000 times.
TEST(RandomNumbers, ShufflesIntoEveryOrderEquallyOften) {
  RandomNumbers random(7);
  std::array<int, 256> seen{};
  for (int trial = 0; trial < 24000; ++trial) {
    std::vector<int> values{0, 1, 2, 3};
    random.shuffle(values);
    ++seen.at(static_cast<std::size_t>(values[0] + 4 * values[1] + 16 * values[2] + 64 * values[3]));
  }
  double chi_squared = 0.0;
  for (const int count : seen) chi_squared += count == 0 ? 0.0 : (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_EQ(std::count_if(seen.begin(), seen.end(), [](int count) { return count > 0; }), 24);
  EXPECT_LT(chi_squared, 60.0);
}

TEST(RandomNumbers, AreBelowTheirCount) {
  RandomNumbers random(3);
  std::array<int, 5> seen{};
  for (int k = 0; k < 5000; ++k) ++seen.at(random.below(5));
  for (const int count : seen) EXPECT_NEAR(count, 1000, 150);
}

}  // namespace
}  // namespace dwell
