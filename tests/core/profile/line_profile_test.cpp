#include "core/profile/line_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dwell {
namespace {

const std::vector<double> kPlaces{-2.0, -1.5, 0.0, 0.25, 1.0, 3.0, 3.5};  // mm

TEST(LineProfile, IntegratesACubicSlopeExactly) {
  std::vector<double> slopes, heights;
  for (const double x : kPlaces) {
    slopes.push_back(1.0 - 2.0 * x + 3.0 * x * x * x);
    heights.push_back(x - x * x + 0.75 * x * x * x * x);
  }
  const LineProfile profile = line_profile(ProfileQuantity::Slope, kPlaces, slopes);
  const std::vector<double> lengths = place_lengths(kPlaces);
  double mean = 0.0, sum = 0.0, length = 0.0;
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    // 1 urad over 1 mm is 1 nm.
    EXPECT_NEAR(profile.height[i] - profile.height[0], heights[i] - heights[0], 1e-11);
    mean += lengths[i] * profile.height[i], sum += lengths[i] * profile.height[i] * profile.height[i];
    length += lengths[i];
  }
  EXPECT_NEAR(mean, 0.0, 1e-10);
  EXPECT_NEAR(profile_figures(profile).height_rms, std::sqrt(sum / length), 1e-10);
  EXPECT_EQ(profile.values(), slopes);
}

TEST(LineProfile, DerivesACubicHeightExactly) {
  std::vector<double> heights;
  for (const double x : kPlaces) heights.push_back(4.0 + x - x * x * x);
  const LineProfile profile = line_profile(ProfileQuantity::Height, kPlaces, heights);
  for (std::size_t i = 0; i < kPlaces.size(); ++i)
    EXPECT_NEAR(profile.slope[i], 1.0 - 3.0 * kPlaces[i] * kPlaces[i], 1e-11);
  EXPECT_EQ(profile.height, heights);
  EXPECT_EQ(profile.values(), heights);
}

TEST(LineProfile, PlacesCountByTheirLengths) {
  EXPECT_EQ(place_lengths({0.0, 1.0, 3.0, 3.5}), (std::vector<double>{1.0, 1.5, 1.25, 0.5}));
  EXPECT_EQ(place_lengths({1.0, 1.5, 2.0}), (std::vector<double>{0.5, 0.5, 0.5}));
  // Mean (0 + 3 + 2.5 + 1.5) / 4.25 = 7 / 4.25.
  const double mean = 7.0 / 4.25;
  const double square =
      (mean * mean + 1.5 * (2 - mean) * (2 - mean) + 1.25 * (2 - mean) * (2 - mean) + 0.5 * (3 - mean) * (3 - mean)) /
      4.25;
  EXPECT_NEAR(rms_about_mean({0.0, 2.0, 2.0, 3.0}, {1.0, 1.5, 1.25, 0.5}), std::sqrt(square), 1e-15);
  const ProfileSpacing spacing = profile_spacing({ProfileQuantity::Slope, {0.0, 1.0, 3.0, 3.5}, {}, {}});
  EXPECT_EQ(spacing.least, 0.5);
  EXPECT_EQ(spacing.median, 1.0);
  EXPECT_EQ(spacing.most, 2.0);
}

}  // namespace
}  // namespace dwell
