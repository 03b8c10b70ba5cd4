#include "paths/metrics/ripple.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/tif/models/removal_models.h"
#include "paths/lines/raster.h"
#include "paths/metrics/path_ripple.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

RemovalFunction mrf() {
  return removal_of_spec(parse_spec_text("mrf:lead=0.35,trail=1.2,width=1.5,angle=20,peak=50", "tif"));
}

/// Removal at a point by lines that go on for ever, every line a sum of small steps.
double brute_force(const std::function<double(Point)>& rate, double pitch, double angle_deg, double v, double reach) {
  const double a = angle_deg * std::numbers::pi / 180.0;
  const double h = 0.004;
  double sum = 0.0;
  for (double at = -reach - pitch; at <= reach + pitch; at += pitch) {  // the line's place: v - at from the point
    const double w = v - (at - std::fmod(-reach - pitch, pitch));
    for (double u = -reach; u <= reach; u += h) {
      sum += h * rate({u * std::cos(a) - w * std::sin(a), u * std::sin(a) + w * std::cos(a)});
    }
  }
  return sum;
}

TEST(RasterRipple, SumOfLinesIsTheDoubleLoop) {
  const RemovalFunction tif = gaussian_removal(2.0, 1.3, 1.9);
  const auto rate = [](Point p) {
    const double r2 = p.x * p.x + p.y * p.y;
    return r2 <= 1.9 * 1.9 ? 2.0 * std::exp(-4.0 * std::numbers::ln2 * r2 / (1.3 * 1.3)) : 0.0;
  };
  for (const double pitch : {0.37, 0.9, 1.7}) {
    const PeriodicSum sum = periodic_sum(line_profile(tif, 0.0), pitch, "pitch");
    double low = 1e300, high = -1e300, mean = 0.0;
    for (int i = 0; i < 64; ++i) {
      const double s = brute_force(rate, pitch, 0.0, pitch * i / 64.0, 1.9);
      low = std::min(low, s), high = std::max(high, s), mean += s / 64.0;
    }
    EXPECT_NEAR(sum.low, low, 2e-4 * mean) << pitch;
    EXPECT_NEAR(sum.high, high, 2e-4 * mean) << pitch;
    EXPECT_NEAR(sum.mean, mean, 2e-4 * mean) << pitch;
  }
}

TEST(RasterRipple, WideGaussianByPoissonSummation) {
  // A Gaussian whose cut is far out: the sum of its tracks is 1 + 2 sum_m exp(-2 (pi m sigma / d)^2) cos(2 pi m v / d).
  const double sigma = 0.8;
  const RemovalFunction tif = gaussian_removal(4.0, sigma * std::sqrt(8.0 * std::numbers::ln2), 8.0 * sigma);
  for (const double pitch : {1.0, 1.5, 2.5}) {
    const double q = std::exp(-2.0 * std::pow(std::numbers::pi * sigma / pitch, 2));
    const RasterRipple ripple = raster_ripple(line_profile(tif, 0.0), pitch, 250.0);
    EXPECT_NEAR(ripple.pvn, 4.0 * q + 4.0 * std::pow(q, 9), 1e-9) << pitch;
    EXPECT_NEAR(ripple.rms, 250.0 * std::sqrt(2.0 * (q * q + std::pow(q, 8))), 1e-7) << pitch;
    EXPECT_NEAR(ripple.feed, tif.volume / (pitch * 250.0), 1e-9 * ripple.feed) << "equation 6";
    EXPECT_EQ(ripple.pitch, pitch);
  }
}

TEST(RasterRipple, GrowsLinearlyWithDepthAndWithPitch) {
  const TrackProfile line = line_profile(mrf(), 110.0);  // across the flow
  const RasterRipple one = raster_ripple(line, 0.8, 1.0);
  for (const double depth : {50.0, 125.0, 443.0}) {
    const RasterRipple ripple = raster_ripple(line, 0.8, depth);
    EXPECT_NEAR(ripple.pve, depth * one.pve, 1e-12 * ripple.pve);
    EXPECT_NEAR(ripple.rms, depth * one.rms, 1e-12 * ripple.rms);
    EXPECT_DOUBLE_EQ(ripple.pvn, one.pvn);
  }
  double previous = 0.0;
  for (double pitch = 0.2; pitch < 2.0; pitch += 0.1) {
    const double pvn = raster_ripple(line, pitch, 1.0).pvn;
    EXPECT_GT(pvn, previous);
    previous = pvn;
  }
}

TEST(RasterRipple, DependsOnTheDirectionOfAnAsymmetricSpot) {
  const RemovalFunction tif = mrf();
  const double across = raster_ripple(line_profile(tif, 110.0), 0.8, 1.0).pvn;
  const double along = raster_ripple(line_profile(tif, 20.0), 0.8, 1.0).pvn;
  EXPECT_GT(across, 100.0 * along);
  EXPECT_NEAR(raster_ripple(line_profile(tif, -70.0), 0.8, 1.0).pvn, across, 1e-5) << "back is as forth";
}

TEST(RasterRipple, RefusesWhatIsNoPitchOrDepth) {
  const TrackProfile line = line_profile(gaussian_removal(1.0, 2.0, 3.0), 0.0);
  EXPECT_EQ(test::message_of([&] { raster_ripple(line, 1.0, -2.0); }),
            "ripple: depth = -2 nm; required finite and > 0");
  for (const double pitch : {0.0, -1.0, test::kNaN, test::kInf, 1e-9}) {
    EXPECT_NE(test::message_of([&] { raster_ripple(line, pitch, 1.0); }).find("ripple: pitch = "), std::string::npos);
  }
}

PathRipple simulated(const RemovalFunction& tif, double pitch, double angle) {
  RasterOptions raster;
  raster.pitch = pitch;
  raster.step = 0.5;
  raster.angle_deg = angle;
  raster.overrun = tif.radius;
  PathRippleOptions options;
  options.depth = 300.0;
  return path_ripple(raster_path(test::full_map(24, 26, 1.0, 1.1, {7.0, -3.0}), raster), tif, options);
}

TEST(PathRipple, OfARasterIsTheExactOne) {
  const RemovalFunction tif = mrf();
  for (const double angle : {0.0, 110.0}) {
    for (const double pitch : {0.8, 1.3}) {
      const PathRipple patch = simulated(tif, pitch, angle);
      const RasterRipple exact = raster_ripple(line_profile(tif, angle), pitch, 300.0);
      // The patch holds no whole number of periods, its pixels miss the extremes by a share of a pixel, and the cut of
      // the spot where it has fallen to 0.2 % of its peak lies on other pixels there.
      EXPECT_NEAR(patch.pvn, exact.pvn, 0.01 * exact.pvn + 6e-4) << angle << " " << pitch;
      EXPECT_NEAR(patch.rms, exact.rms, 0.02 * exact.rms + 0.02) << angle << " " << pitch;
      EXPECT_NEAR(patch.feed, exact.feed, 0.01 * exact.feed) << angle << " " << pitch;
      EXPECT_NEAR(patch.spacing, pitch, 0.12 * pitch);
    }
  }
}

TEST(PathRipple, SpectrumOfARasterHasItsPitchAndDirection) {
  const PathRipple patch = simulated(mrf(), 1.3, 110.0);
  ASSERT_FALSE(patch.spectrum.peaks.empty());
  const RipplePeak& peak = patch.spectrum.peaks.front();
  EXPECT_NEAR(peak.wavelength, 1.3, 0.01);
  EXPECT_NEAR(peak.direction_deg, 20.0, 0.5);
  EXPECT_GT(peak.share, 0.8);
  EXPECT_GT(patch.spectrum.anisotropy, 0.9);
  EXPECT_NEAR(patch.spectrum.rms, patch.rms, 0.05 * patch.rms);
}

TEST(PathRipple, RefusesWhatItCannotSimulate) {
  const RemovalFunction tif = gaussian_removal(1.0, 2.0, 3.0);
  RasterOptions raster;
  raster.pitch = 1.0;
  const ToolPath small = raster_path(test::full_map(5, 5), raster);
  const auto message = [&](const ToolPath& path, const PathRippleOptions& options) {
    return test::message_of([&] { path_ripple(path, tif, options); });
  };
  EXPECT_NE(message(small, {}).find("nothing is left within the removal function's radius of 3 mm"), std::string::npos);
  PathRippleOptions o;
  o.depth = 0.0;
  EXPECT_EQ(message(small, o), "path ripple: depth = 0 nm; required finite and > 0");
  o = {};
  o.side = -1.0;
  EXPECT_EQ(message(small, o), "path ripple: side = -1 mm; required finite and > 0");
  o.side = 2.0;
  o.pixel = test::kNaN;
  EXPECT_EQ(message(small, o), "path ripple: pixel = nan mm; required finite and > 0");
  o.pixel = 1e-4;
  EXPECT_NE(message(small, o).find("has 20000 pixels of 0.0001 mm; at most 4096 accepted"), std::string::npos);
  o.pixel.reset();
  o.centre = Point{100.0, 0.0};
  EXPECT_NE(message(small, o).find("no moving stroke in the patch"), std::string::npos);
  // A hole that the tool does not reach across.
  const ToolPath wall{"file", {{0, 0}, {0, 1}, {0, 2}, {0, 3}}, {1, 0, 0, 0}};
  o.centre = Point{2.0, 1.5};
  o.side = 6.0;
  EXPECT_NE(message(wall, o).find("leaves part of the patch untouched"), std::string::npos);
}

}  // namespace
}  // namespace dwell
