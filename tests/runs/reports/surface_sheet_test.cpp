#include "runs/reports/surface_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dwell {
namespace {

/// A wave along x, on pixels that are not square.
HeightMap wave(double amplitude, double wavelength) {
  HeightMap map(Grid{90, 160, 0.25, 0.4, {3.0, -2.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const double phase = 2.0 * std::numbers::pi * map.grid.centre(i).x / wavelength;
    map.values[static_cast<std::size_t>(i)] = amplitude * std::sin(phase + 0.3);
  }
  return map;
}

TEST(SurfaceSheet, PutsAWaveIntoItsBandAndGivesItsSlope) {
  // Of a tool of FWHM 4 mm: bands above 8 mm, from there to 2 mm, and below.
  const SurfaceSheet sheet = surface_sheet(wave(10.0, 4.0), wave(3.0, 1.0), 4.0, 1, {});
  ASSERT_EQ(sheet.before.bands.size(), 3u);
  EXPECT_EQ(sheet.before.bands[1].longest, 8.0);
  EXPECT_EQ(sheet.before.bands[1].shortest, 2.0);
  EXPECT_NEAR(sheet.before.bands[1].rms.value(), 10.0 / std::numbers::sqrt2, 0.1);
  EXPECT_LT(sheet.before.bands[0].rms.value(), 0.1);
  EXPECT_LT(sheet.before.bands[2].rms.value(), 0.1);
  EXPECT_NEAR(sheet.after.bands[2].rms.value(), 3.0 / std::numbers::sqrt2, 0.03);
  EXPECT_LT(sheet.after.bands[1].rms.value(), 0.03);
  // Over one pitch of 0.25 mm a wave of length L rises by 2 A sin(pi h / L) at most.
  const auto slope = [](double amplitude, double length) {
    return 2.0 * amplitude * std::sin(std::numbers::pi * 0.25 / length) / 0.25 / std::numbers::sqrt2;
  };
  EXPECT_NEAR(sheet.before.slope.total, slope(10.0, 4.0), 0.01 * slope(10.0, 4.0));
  EXPECT_NEAR(sheet.after.slope.total, slope(3.0, 1.0), 0.01 * slope(3.0, 1.0));
  EXPECT_NEAR(sheet.before.slope.y, 0.0, 1e-9);
}

// A piston that counts, as with --remove none, is in no band.
TEST(SurfaceSheet, AMeanLeaksIntoNoBand) {
  HeightMap raised = wave(10.0, 4.0);
  for (double& value : raised.values) value += 500.0;
  const SurfaceSheet sheet = surface_sheet(wave(10.0, 4.0), raised, 4.0, 1, {});
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(sheet.after.bands[k].rms.value(), sheet.before.bands[k].rms.value(), 1e-6);
  EXPECT_NEAR(sheet.after.longer, sheet.before.longer, 1e-6);
}

TEST(SurfaceSheet, SaysWhatItGivesWithUnitsAndWhatThePixelsCannotShow) {
  const SurfaceSheet sheet = surface_sheet(wave(10.0, 4.0), wave(3.0, 4.0), 0.3, 1, {});
  const std::string text = surface_lines(sheet);
  EXPECT_NE(text.find("urad RMS before"), std::string::npos) << text;
  EXPECT_NE(text.find("7.0"), std::string::npos) << text;
  EXPECT_NE(text.find("wavelengths < 0.15 mm not resolved: two pixels are 0.5 mm"), std::string::npos) << text;
  EXPECT_NE(text.find("Hann window"), std::string::npos) << text;
  const nlohmann::ordered_json block = surface_block(sheet);
  EXPECT_TRUE(block["before"]["bands"][2]["rms_nm"].is_null());
  EXPECT_NEAR(block["after"]["bands"][0]["rms_nm"].get<double>(), 3.0 / std::numbers::sqrt2, 0.03);
  EXPECT_EQ(block["after"]["slope_rms_urad"]["x"].get<double>(), sheet.after.slope.x);
}

}  // namespace
}  // namespace dwell
