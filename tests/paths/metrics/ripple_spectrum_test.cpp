#include "paths/metrics/ripple_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/spectra/psd.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Waves over a non-square map with unequal pitches: amplitude [nm], wavelength [mm], direction [deg].
struct Wave {
  double amplitude, wavelength, direction;
};

HeightMap waves(const std::vector<Wave>& waves, Index rows = 360, Index cols = 500) {
  HeightMap map(Grid{rows, cols, 0.2, 0.25, {-31.0, 12.5}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    double& z = map.values[static_cast<std::size_t>(i)];
    z = 40.0 + 0.3 * p.x - 0.1 * p.y;  // piston and tilt do not count
    for (const Wave& w : waves) {
      const double a = w.direction * std::numbers::pi / 180.0;
      z += w.amplitude * std::sin(kTwoPi * (p.x * std::cos(a) + p.y * std::sin(a)) / w.wavelength);
    }
  }
  return map;
}

/// Hou, Liao, Wang 2017, figure 2: the RMS of the band 0.12-33 mm is linear in the amplitude of a sinusoidal ripple and
/// does not depend on its frequency. Exact value of a sine: amplitude / sqrt(2).
TEST(RippleSpectrum, BandRmsIsLinearInAmplitudeAndIndependentOfFrequency) {
  for (const double wavelength : {0.8, 1.7, 3.0, 6.1, 12.0}) {
    for (const double amplitude : {1.0, 5.0, 25.0}) {
      const RippleSpectrum spectrum = ripple_spectrum(waves({{amplitude, wavelength, 0.0}}));
      EXPECT_NEAR(spectrum.rms, amplitude / std::numbers::sqrt2, 0.02 * amplitude) << wavelength;
    }
    const double one = ripple_spectrum(waves({{1.0, wavelength, 0.0}})).rms;
    EXPECT_NEAR(ripple_spectrum(waves({{7.0, wavelength, 0.0}})).rms, 7.0 * one, 1e-9) << "exactly linear";
  }
}

TEST(RippleSpectrum, BandRmsIsThatOfCorePsd) {
  const HeightMap map = waves({{3.0, 2.0, 25.0}, {2.0, 9.0, -70.0}});
  const RippleSpectrum spectrum = ripple_spectrum(map, {0.6, 20.0});
  const std::vector<double> squares = band_mean_squares(areal_psd(map, {}), {1.0 / 20.0, 1.0 / 0.6});
  EXPECT_NEAR(spectrum.rms, std::sqrt(squares[1]), 0.01 * spectrum.rms) << "but for the tilt taken out here";
  EXPECT_EQ(spectrum.resolved.shortest, 0.6);
  EXPECT_EQ(spectrum.resolved.longest, 20.0);
  EXPECT_EQ(ripple_spectrum(map).resolved.longest, 33.0);
  EXPECT_NEAR(ripple_spectrum(map).resolved.shortest, 0.4, 1e-12) << "two pixels";
}

TEST(RippleSpectrum, FindsWavesWithTheirDirections) {
  const RippleSpectrum spectrum =
      ripple_spectrum(waves({{4.0, 3.0, 30.0}, {2.0, 5.0, -60.0}, {1.0, 1.1, 90.0}, {0.05, 2.0, 10.0}}));
  ASSERT_EQ(spectrum.peaks.size(), 3u) << "the last has less than 1 % of the power";
  const std::vector<Wave> expected{{4.0, 3.0, 30.0}, {2.0, 5.0, -60.0}, {1.0, 1.1, 90.0}};
  for (std::size_t k = 0; k < 3; ++k) {
    const RipplePeak& peak = spectrum.peaks[k];
    EXPECT_NEAR(peak.wavelength, expected[k].wavelength, 0.003 * expected[k].wavelength);
    EXPECT_NEAR(peak.direction_deg, expected[k].direction, 0.3);
    EXPECT_NEAR(peak.rms, expected[k].amplitude / std::numbers::sqrt2, 0.03 * expected[k].amplitude);
    EXPECT_NEAR(peak.share, peak.rms * peak.rms / (spectrum.rms * spectrum.rms), 1e-12);
  }
}

TEST(RippleSpectrum, CrestsAlongXHaveOneName) {
  for (const double wavelength : {1.3, 2.0, 3.1, 4.7}) {
    for (const double direction : {90.0, -90.0}) {
      const RippleSpectrum spectrum = ripple_spectrum(waves({{1.0, wavelength, direction}}));
      ASSERT_FALSE(spectrum.peaks.empty());
      EXPECT_NEAR(spectrum.peaks[0].direction_deg, 90.0, 0.1);
    }
  }
}

TEST(RippleSpectrum, FindsWavesOnARoundPartWithAHole) {
  HeightMap map = waves({{4.0, 3.0, -35.0}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const double r = distance(map.grid.centre(i), {20.0, 55.0});
    if (r > 42.0 || r < 9.0) map.values[static_cast<std::size_t>(i)] = test::kNaN;
  }
  const RippleSpectrum spectrum = ripple_spectrum(map);
  ASSERT_FALSE(spectrum.peaks.empty());
  EXPECT_NEAR(spectrum.peaks[0].wavelength, 3.0, 0.02);
  EXPECT_NEAR(spectrum.peaks[0].direction_deg, -35.0, 0.5);
  EXPECT_NEAR(spectrum.rms, 4.0 / std::numbers::sqrt2, 0.2);
}

TEST(RippleSpectrum, AnisotropyTellsDirections) {
  HeightMap noise = waves({});
  std::mt19937_64 random(5);
  for (double& z : noise.values) z += static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
  EXPECT_LT(ripple_spectrum(noise, {0.6, 10.0}).anisotropy, 0.05);
  EXPECT_GT(ripple_spectrum(waves({{1.0, 2.0, 40.0}})).anisotropy, 0.9);
  EXPECT_GT(ripple_spectrum(waves({{1.0, 2.0, 0.0}, {1.0, 2.0, 90.0}})).anisotropy, 0.85);
  HeightMap half = noise;
  const HeightMap wave = waves({{0.29 * std::numbers::sqrt2 * 0.5, 2.0, 40.0}});
  for (std::size_t i = 0; i < half.values.size(); ++i) half.values[i] += wave.values[i];
  const double mixed = ripple_spectrum(half, {0.6, 10.0}).anisotropy;
  EXPECT_GT(mixed, 0.2);
  EXPECT_LT(mixed, 0.8);
}

TEST(RippleSpectrum, AFlatMapHasNone) {
  const RippleSpectrum spectrum = ripple_spectrum(test::full_map(64, 80));
  EXPECT_LE(spectrum.rms, 1e-12);
  EXPECT_TRUE(std::isfinite(spectrum.anisotropy));
}

TEST(RippleSpectrum, RefusesABandItCannotShow) {
  const HeightMap map = test::full_map(10, 12);
  const auto message = [&](const RippleBand& band) { return test::message_of([&] { ripple_spectrum(map, band); }); };
  EXPECT_EQ(message({2.0, 1.0}), "ripple: band = 2 to 1 mm; required 0 < shortest < longest, finite");
  EXPECT_EQ(message({test::kNaN, 1.0}), "ripple: band = nan to 1 mm; required 0 < shortest < longest, finite");
  EXPECT_EQ(message({0.1, test::kInf}), "ripple: band = 0.1 to inf mm; required 0 < shortest < longest, finite");
  EXPECT_EQ(
      message({0.1, 1.5}),
      "ripple: a map of 12 x 10 mm shows wavelengths of 2 to 6 mm, none of the band of 0.1 to 1.5 mm; required: a "
      "larger map or finer pixels");
}

}  // namespace
}  // namespace dwell
