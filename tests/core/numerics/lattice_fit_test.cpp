#include "core/numerics/lattice_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dwell {
namespace {

TEST(LatticeFit, FindsPitchOriginAndCountInAnyOrder) {
  const LatticeFit fit = fit_lattice({0.7, 0.1, 0.4, 0.1, 1.3, 1.0, 0.4});
  ASSERT_TRUE(fit.fits);
  EXPECT_DOUBLE_EQ(fit.lattice.pitch, 0.3);
  EXPECT_DOUBLE_EQ(fit.lattice.origin, 0.1);
  EXPECT_EQ(fit.lattice.count, 5);
  EXPECT_EQ(fit.lattice.nearest(0.7), 2);
}

TEST(LatticeFit, DoesNotDriftOverRoundedCoordinates) {
  // 3000 steps of 0.0938 printed with three decimals: one step alone tells the pitch to half a per cent only.
  std::vector<double> v;
  for (int k = 0; k < 3000; ++k) {
    if (k < 1000 || k > 1400) v.push_back(std::round((5.0 + 0.0938 * k) * 1e3) / 1e3);
  }
  const LatticeFit fit = fit_lattice(v);
  ASSERT_TRUE(fit.fits);
  EXPECT_NEAR(fit.lattice.pitch, 0.0938, 1e-7);
  EXPECT_EQ(fit.lattice.count, 3000);
}

TEST(LatticeFit, TakesSinglePrecisionNoiseAsOneCoordinate) {
  std::vector<double> v;
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (int k = 0; k < 500; ++k) v.push_back(static_cast<float>(100.0 + 0.1 * k) + 1e-6 * repeat);
  }
  const LatticeFit fit = fit_lattice(v);
  ASSERT_TRUE(fit.fits);
  EXPECT_NEAR(fit.lattice.pitch, 0.1, 1e-7);
  EXPECT_EQ(fit.lattice.count, 500);
}

TEST(LatticeFit, FindsTheLatticeUnderManyMissingLines) {
  const LatticeFit fit = fit_lattice({0, 1, 3, 6, 8, 9, 12, 14});  // median step 2, which does not hold them all
  ASSERT_TRUE(fit.fits);
  EXPECT_DOUBLE_EQ(fit.lattice.pitch, 1.0);
  EXPECT_EQ(fit.lattice.count, 15);
}

TEST(LatticeFit, UsesTheGivenPitchWhereNoStepShowsIt) {
  EXPECT_FALSE(fit_lattice({0, 2, 5, 10}).fits);
  const LatticeFit fit = fit_lattice({0, 2, 5, 10}, 1.0);
  ASSERT_TRUE(fit.fits);
  EXPECT_DOUBLE_EQ(fit.lattice.pitch, 1.0);
  EXPECT_EQ(fit.lattice.count, 11);
}

TEST(LatticeFit, AStrayDeviatesMost) {
  for (const double stray : {3.1, 3.37, 3.5, 3.93, 20.4, -7.5}) {
    std::vector<double> v{stray};
    for (int k = 0; k < 12; ++k) v.push_back(k);
    const LatticeFit fit = fit_lattice(v);
    EXPECT_FALSE(fit.fits) << stray;
    const auto worst = std::max_element(
        v.begin(), v.end(), [&](double a, double b) { return fit.lattice.deviation(a) < fit.lattice.deviation(b); });
    EXPECT_EQ(*worst, stray);
  }
}

TEST(LatticeFit, OneCoordinateHasNoPitch) {
  const LatticeFit fit = fit_lattice({2.0, 2.0});
  ASSERT_TRUE(fit.fits);
  EXPECT_EQ(fit.lattice.pitch, 0.0);
  EXPECT_EQ(fit.lattice.count, 1);
  EXPECT_EQ(fit.lattice.origin, 2.0);
}

TEST(LatticeFit, SurvivesAbsurdCoordinates) {
  EXPECT_FALSE(fit_lattice({-1e308, 0.0, 1.0, 2.0, 1e308}).fits);
  const LatticeFit far = fit_lattice({0.0, 1.0, 2.0, 3.0, 1e12});
  EXPECT_EQ(far.lattice.pitch, 1.0);
  EXPECT_EQ(far.lattice.count, 1'000'000'000'001);
  const Lattice fine{0.0, 1e-300, 1};
  EXPECT_EQ(fine.nearest(-1.0), -1'000'000'000'000'000);
  EXPECT_EQ(fine.nearest(1e10), 1'000'000'000'000'000);
}

}  // namespace
}  // namespace dwell
