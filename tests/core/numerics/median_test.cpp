#include "core/numerics/median.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/tif/calibration/spot_truth.h"

namespace dwell {
namespace {

TEST(UpperMedian, IsTheMiddleOneOrTheUpperOfTwo) {
  EXPECT_EQ(upper_median({7.0}), 7.0);
  EXPECT_EQ(upper_median({9.0, -4.0}), 9.0);
  EXPECT_EQ(upper_median({9.0, -4.0, 1.0}), 1.0);
  EXPECT_EQ(upper_median({3.0, 9.0, -4.0, 1.0}), 3.0);
  EXPECT_EQ(upper_median({2.0, 2.0, 5.0, 2.0, -8.0}), 2.0);
}

TEST(UpperMedian, OfAbsoluteValuesIsTheSigmaOfNoiseWithOutliers) {
  test::Noise noise(7);
  std::vector<double> sizes;
  for (int k = 0; k < 20'000; ++k) sizes.push_back(std::abs(3.0 * noise()));
  const double clean = kSigmaPerMedianDeviation * upper_median(sizes);
  EXPECT_NEAR(clean, 3.0, 0.06);
  for (int k = 0; k < 100; ++k) sizes.push_back(1e6);
  EXPECT_NEAR(kSigmaPerMedianDeviation * upper_median(sizes), clean, 0.03);
}

}  // namespace
}  // namespace dwell
