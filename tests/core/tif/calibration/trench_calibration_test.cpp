#include "core/tif/calibration/trench_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/numerics/abel_inversion.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/tif/calibration/spot_truth.h"

namespace dwell {
namespace {

using test::expect_input_error;

/// Two Gaussians, the inner one a dent: a ring.
double ring_rate(double r) { return 9.0 * std::exp(-0.5 * r * r / 1.44) - 5.0 * std::exp(-0.5 * r * r / 0.25); }

/// Its Abel transform: each Gaussian's is sigma sqrt(2 pi) times itself.
double ring_section(double v) {
  const double root = std::sqrt(2.0 * std::numbers::pi);
  return root * (9.0 * 1.2 * std::exp(-0.5 * v * v / 1.44) - 5.0 * 0.5 * std::exp(-0.5 * v * v / 0.25));
}

TEST(AbelInversion, GivesBackARingFromItsLineIntegrals) {
  for (const double noise : {0.0, 0.05}) {
    test::Noise random(4);
    std::vector<LineIntegral> lines;
    for (int k = -60; k <= 60; ++k) {
      const double v = 0.083 * k + 0.02;
      lines.push_back({v, ring_section(v) + noise * random(), 1.0});
    }
    const RadialProfile profile = abel_inversion(lines, 5.0, 60);
    double square = 0.0;
    for (int k = 0; k < 100; ++k) {
      const double r = 0.04 * k;
      EXPECT_NEAR(profile(r), ring_rate(r), noise > 0.0 ? 0.25 : 0.06) << r;
      square += std::pow(profile(r) - ring_rate(r), 2) / 100.0;
    }
    EXPECT_LE(std::sqrt(square), noise > 0.0 ? 0.08 : 0.02);
    EXPECT_NEAR(profile.misfit, noise, 0.3 * noise + 0.01);
    EXPECT_EQ(profile(6.0), 0.0);
  }
}

/// A trench of the ring tool from u = -6 to 6 mm of the track, with tilt and noise, made by summing the tool along it.
HeightMap trench(const Grid& grid, double direction, Point through, double feed, double noise) {
  const double a = direction * std::numbers::pi / 180.0;
  HeightMap depth(grid);
  test::Noise random(9);
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i) - through;
    const double u = std::cos(a) * p.x + std::sin(a) * p.y, v = -std::sin(a) * p.x + std::cos(a) * p.y;
    double sum = 0.0;
    constexpr double kStep = 0.05;
    for (double s = -12.0 + 0.5 * kStep; s < 12.0; s += kStep) {
      if (std::abs(u - s) < 7.0) sum += kStep * ring_rate(std::hypot(u - s, v));
    }
    depth.values[static_cast<std::size_t>(i)] = sum / feed + 3.0 + 0.4 * p.x - 0.3 * p.y + noise * random();
  }
  return depth;
}

TEST(CalibrateTrench, RecoversTheToolThatCutIt) {
  const Grid grid{130, 160, 0.25, 0.22, {-20.0, -13.0}};
  for (const double direction : {0.0, 33.0}) {
    const HeightMap depth = trench(grid, direction, {0.7, 1.2}, 0.5, 0.3);
    TrenchOptions options;
    options.feed = 0.5;
    options.direction = direction;
    options.radius = 4.5;
    const TrenchCalibration t = calibrate_trench(depth, options);
    const double a = direction * std::numbers::pi / 180.0;
    EXPECT_NEAR(t.middle, -std::sin(a) * 0.7 + std::cos(a) * 1.2, 0.02);
    EXPECT_GE(t.to - t.from, 10.0);
    EXPECT_LE(t.to - t.from, 22.0);
    EXPECT_LE(t.asymmetry, 0.03);
    EXPECT_NEAR(t.scatter, 0.3, 0.1);
    double square = 0.0, truth = 0.0;
    for (double r = 0.0; r < 4.0; r += 0.05) {
      square += r * std::pow(t.profile(r) - ring_rate(r), 2), truth += r * std::pow(ring_rate(r), 2);
    }
    EXPECT_LE(std::sqrt(square / truth), 0.03) << direction;
    EXPECT_EQ(t.rates.quantity, MapQuantity::Rate);
    EXPECT_NEAR(t.rates.at(t.rates.grid.rows / 2, t.rates.grid.cols / 2 + 6), t.profile(1.5), 1e-9);
  }
}

TEST(CalibrateTrench, RefusesWhatItCannotUse) {
  const Grid grid{130, 160, 0.25, 0.22, {-20.0, -13.0}};
  const HeightMap depth = trench(grid, 0.0, {0.7, 1.2}, 0.5, 0.1);
  const auto with = [&](double feed, double direction) {
    return [&depth, feed, direction] {
      TrenchOptions options;
      options.feed = feed;
      options.direction = direction;
      calibrate_trench(depth, options);
    };
  };
  expect_input_error(with(0.0, 0.0), {"`feed` = 0 mm/min", "from 0.01"});
  expect_input_error(with(std::nan(""), 0.0), {"`feed` = nan"});
  expect_input_error(with(1.0, 90.0), {"`direction` = 90 deg", "runs at"});
  HeightMap swapped = depth;
  for (double& v : swapped.values) v = -v;
  TrenchOptions options;
  options.feed = 0.5;
  expect_input_error([&] { calibrate_trench(swapped, options); }, {"higher after than before"});
  expect_input_error([&] { calibrate_trench(HeightMap(grid), options); }, {"0 pixels with data"});
}

}  // namespace
}  // namespace dwell
