#include "paths/metrics/track_overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/tif/models/planetary_shape.h"
#include "core/tif/models/removal_models.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

constexpr double kDiameter = 3.6;  // pad of radius 1 whose centre revolves at 0.8

TrackProfile planetary_section() {
  const RemovalShape shape = planetary_shape(1.0, 0.8, -1.0);
  return {[shape](double v) { return std::abs(v) <= shape.reach ? shape.value({0.0, v}) : 0.0; }, -1.8, 1.8};
}

/// Zha et al. 2020, table 1 has its smallest deviation at 40 %. Over which width they took it is not said; over one
/// period of many tracks the figures are these (share of the revolution under the pad in closed form, summed over 41
/// tracks at 20,000 positions, NumPy). Tolerance: theirs are rounded to 4 digits, the period there was not sampled as
/// here.
TEST(TrackOverlap, PlanetaryToolIsMostEvenAtFortyPerCent) {
  const std::vector<double> overlaps{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  const std::vector<double> expected{0.2335, 0.2054, 0.1720, 0.1237, 0.1268, 0.2304};
  const TrackProfile section = planetary_section();
  for (std::size_t k = 0; k < overlaps.size(); ++k) {
    const TrackOverlap track = track_overlap(section, kDiameter, overlaps[k]);
    EXPECT_NEAR(track.deviation, expected[k], 5e-4) << overlaps[k];
    EXPECT_DOUBLE_EQ(track.pitch, (1.0 - overlaps[k]) * kDiameter);
  }
  EXPECT_EQ(best_overlap(section, kDiameter, overlaps).overlap, 0.4);
}

TEST(TrackOverlap, AgreesWithADoubleLoop) {
  const RemovalFunction tif =
      removal_of_spec(parse_spec_text("mrf:lead=0.4,trail=1.1,width=1.6,angle=70,peak=9", "tif"));
  const TrackProfile line = line_profile(tif, 10.0);
  const double pitch = 0.7 * 2.0 * tif.radius;
  double peak = 0.0;
  for (int i = 0; i <= 20000; ++i) peak = std::max(peak, line.value(-tif.radius + 2.0 * tif.radius * i / 20000.0));
  std::vector<double> sum(1000, 0.0);
  double mean = 0.0, square = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (int k = -5; k <= 5; ++k) sum[i] += line.value(pitch * (static_cast<double>(i) / 1000.0 + k)) / peak;
    mean += sum[i] / 1000.0;
  }
  for (const double s : sum) square += (s - mean) * (s - mean) / 1000.0;
  EXPECT_NEAR(track_overlap(line, 2.0 * tif.radius, 0.3).deviation, std::sqrt(square), 1e-4);
}

TEST(TrackOverlap, WhatMovesIsNotWhatStands) {
  // On the move a track's section is the line integral: the same tool is most even at another overlap.
  const RemovalFunction tif = removal_of_spec(parse_spec_text("planetary:radius=1,eccentricity=0.8,peak=9", "tif"));
  const std::vector<double> overlaps{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  EXPECT_EQ(best_overlap(axis_profile(tif, 0.0), kDiameter, overlaps).overlap, 0.4);
  EXPECT_EQ(best_overlap(line_profile(tif, 0.0), kDiameter, overlaps).overlap, 0.5);
}

TEST(AutoPitch, IsTheWidestEvenOneWithNoWorseBelow) {
  for (const char* text : {"gaussian:peak=4,fwhm=2", "disc:slope=1,radius=2", "mrf:lead=0.4,trail=1.1,width=1.6,peak=9",
                           "planetary:radius=1,eccentricity=0.8,peak=9"}) {
    const RemovalFunction tif = removal_of_spec(parse_spec_text(text, "tif"));
    const double size = 2.0 * tif.radius;
    const TrackProfile line = line_profile(tif, 90.0);
    for (const double most : {0.01, 0.05}) {
      const AutoPitch chosen = widest_pitch(line, size, most);
      const double pitch = chosen.ripple.pitch;
      EXPECT_LE(chosen.ripple.pvn, most) << text;
      for (double narrower = pitch; narrower > 0.025 * size; narrower /= 1.017) {
        EXPECT_LE(raster_ripple(line, narrower, 1.0).pvn, most * 1.02) << text << " " << narrower;
      }
      double worst = 0.0;  // within the rounding to three figures and the step of the search
      for (double share = 1.0; share < 1.03; share += 0.0005) {
        worst = std::max(worst, raster_ripple(line, pitch * share, 1.0).pvn);
      }
      EXPECT_GT(worst, most) << text;
      EXPECT_NEAR(chosen.track.pitch, pitch, 1e-9);
      EXPECT_NEAR(std::round(pitch * 1e4) * 1e-4, pitch, 1e-9) << "three figures";
    }
  }
}

TEST(TrackOverlap, RefusesWhatIsOutOfRange) {
  const TrackProfile section = planetary_section();
  EXPECT_EQ(test::message_of([&] { track_overlap(section, kDiameter, 1.0); }), "overlap = 1; required 0 to 0.99");
  EXPECT_EQ(test::message_of([&] { track_overlap(section, kDiameter, test::kNaN); }),
            "overlap = nan; required 0 to 0.99");
  EXPECT_EQ(test::message_of([&] { track_overlap(section, 0.0, 0.5); }),
            "overlap: diameter = 0 mm; required finite and > 0");
  EXPECT_EQ(test::message_of([&] { best_overlap(section, 1.0, {}); }),
            "overlap: none to choose from; at least one is required");
  EXPECT_EQ(test::message_of([&] { widest_pitch(section, kDiameter, 1.5); }),
            "raster: ripple = 1.5; required > 0 and < 1 (peak to valley over removal)");
  EXPECT_NE(test::message_of([&] { widest_pitch(section, kDiameter, 1e-6); }).find("a fiftieth"), std::string::npos);
}

}  // namespace
}  // namespace dwell
