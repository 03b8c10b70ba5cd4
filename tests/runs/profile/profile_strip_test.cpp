#include "runs/profile/profile_strip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/base/expect_error.h"
#include "tests/core/base/temporary_folder.h"

namespace dwell {
namespace {

ProfileInput report_of(const std::string& text) {
  const test::TemporaryFolder folder;
  return read_profile(folder.file("line.csv", text), {}, parse_profile_form("none"));
}

TEST(ProfileStrip, HasTheHeightsOfTheProfileInEveryRow) {
  const ProfileInput report = report_of("x_mm,height_nm\n-0.2,5\n0.1,7\n0.4,-3\n0.7,2.5\n1,0\n");
  const HeightMap line = profile_strip(report, 0.0);
  EXPECT_EQ(line.grid.rows, 1);
  EXPECT_NEAR(line.grid.pitch_x, 0.3, 1e-15);
  EXPECT_EQ(line.grid.pitch_y, line.grid.pitch_x);
  EXPECT_EQ(line.grid.origin.x, -0.2);
  EXPECT_EQ(line.grid.origin.y, 0.0);
  EXPECT_EQ(line.values, report.rest.profile.height);
  const HeightMap strip = profile_strip(report, 1.2);
  EXPECT_EQ(strip.grid.rows, 4);
  EXPECT_NEAR(strip.grid.origin.y, -0.45, 1e-12);
  for (Index row = 0; row < 4; ++row) {
    for (Index col = 0; col < 5; ++col) EXPECT_EQ(strip.at(row, col), line.at(0, col));
  }
  ASSERT_EQ(strip.history.size(), 1u);
}

TEST(ProfileStrip, PutsUnevenPlacesOnEvenPixels) {
  std::string text = "x_mm,height_nm\n";
  const auto height = [](double x) { return 1.0 + 2.0 * x - 3.0 * x * x + 0.5 * x * x * x; };
  for (const double x : {0.0, 0.5, 1.0, 1.5, 1.6, 2.9, 3.4})
    text += std::to_string(x) + "," + std::to_string(height(x)) + "\n";
  const HeightMap map = profile_strip(report_of(text), 0.0);
  EXPECT_EQ(map.grid.pitch_x, 0.5);
  ASSERT_EQ(map.grid.cols, 7);  // to 3 mm; 3.5 would lie beyond
  for (Index col = 0; col < 7; ++col) EXPECT_NEAR(map.at(0, col), height(map.grid.x(col)), 1e-5);
}

TEST(ProfileStrip, RefusesOtherWidthsAndTooManyPixels) {
  const ProfileInput report = report_of("x_mm,height_nm\n0,5\n0.5,7\n1,-3\n1.5,2.5\n");
  test::expect_input_error([&] { profile_strip(report, 0.7); }, {"`line width` = 0.7 mm", "0.5 mm"});
  test::expect_input_error([&] { profile_strip(report, 0.2); }, {"`line width`"});
  test::expect_input_error([&] { profile_strip(report, 1e9); }, {"the strip of the profile"});
}

}  // namespace
}  // namespace dwell
