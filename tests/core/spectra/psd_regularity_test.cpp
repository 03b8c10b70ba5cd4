#include "core/spectra/psd_regularity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

const Grid kGrid{90, 120, 0.5, 0.4, {-7.0, 3.0}};

/// A wave of the length `wavelength` that runs towards `degrees`.
HeightMap wave(double wavelength, double degrees, double amplitude = 1.0) {
  HeightMap map(kGrid);
  const double angle = degrees * std::numbers::pi / 180.0;
  for (Index i = 0; i < kGrid.size(); ++i) {
    const Point p = kGrid.centre(i);
    map.values[static_cast<std::size_t>(i)] =
        amplitude *
        std::cos(2.0 * std::numbers::pi / wavelength * (p.x * std::cos(angle) + p.y * std::sin(angle)) + 0.4);
  }
  return map;
}

PsdRegularity of(const HeightMap& map) { return psd_regularity(areal_psd(map, {}), 1.5, 15.0); }

TEST(PsdRegularity, FindsAWaveAndItsDirection) {
  for (const double degrees : {0.0, 35.0, 90.0, 140.0}) {
    const PsdRegularity r = of(wave(4.0, degrees, 3.0));
    SCOPED_TRACE(degrees);
    EXPECT_NEAR(r.wavelength(), 4.0, 0.2);
    const double off = std::abs(r.direction() - degrees);
    EXPECT_LE(std::min(off, 180.0 - off), 4.0);
    EXPECT_GT(r.peak_over_mean(), 100.0);
    EXPECT_GT(r.anisotropy, 0.95);
    EXPECT_GT(r.sector_over_mean, degrees == 35.0 || degrees == 140.0 ? 8.0 : 11.0);
    EXPECT_NEAR(r.rms, 3.0 / std::numbers::sqrt2, 0.05);
  }
}

TEST(PsdRegularity, TellsFourfoldFromOneDirection) {
  HeightMap both = wave(4.0, 0.0);
  const HeightMap other = wave(4.0, 90.0);
  for (std::size_t i = 0; i < both.values.size(); ++i) both.values[i] += other.values[i];
  const PsdRegularity r = of(both);
  EXPECT_LT(r.anisotropy, 0.02);
  EXPECT_NEAR(r.sector_over_mean, 6.0, 0.5);
}

TEST(PsdRegularity, FindsNoneInNoise) {
  HeightMap map(kGrid);
  std::mt19937_64 random(5);
  for (double& v : map.values) v = static_cast<double>(random() >> 11) * 0x1p-53;
  const PsdRegularity r = of(map);
  EXPECT_LT(r.peak_over_mean(), 20.0);
  EXPECT_GT(r.peak_over_mean(), 3.0);
  EXPECT_LT(r.anisotropy, 0.1);
  EXPECT_LT(r.sector_over_mean, 1.5);
}

TEST(PsdRegularity, RefusesABandWithoutFrequencies) {
  const ArealPsd psd = areal_psd(wave(4.0, 0.0), {});
  test::expect_input_error([&] { psd_regularity(psd, 3.0, 2.0); }, {"3 to 2 mm", "0 < shortest < longest"});
  test::expect_input_error([&] { psd_regularity(psd, 0.0, 2.0); }, {"0 to 2 mm"});
  test::expect_input_error([&] { psd_regularity(psd, 0.1, 0.2); }, {"0 frequencies"});
  HeightMap flat(kGrid, std::vector<double>(static_cast<std::size_t>(kGrid.size()), 0.0));
  test::expect_input_error([&] { of(flat); }, {"nothing at any"});
}

}  // namespace
}  // namespace dwell
