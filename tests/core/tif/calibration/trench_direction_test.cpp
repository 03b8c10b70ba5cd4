#include "core/tif/calibration/trench_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/tif/calibration/trench_calibration.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/tif/calibration/spot_truth.h"

namespace dwell {
namespace {

constexpr double kSigma = 1.7;  // FWHM 4 mm

/// A trench of a Gaussian tool of 12 nm/s moved at 0.5 mm/s from end to end of the map, off its middle. [nm]
HeightMap gaussian_trench(double direction, double noise, std::uint64_t seed) {
  const double a = direction * std::numbers::pi / 180.0;
  HeightMap depth(Grid{140, 150, 0.25, 0.25, {-20.0, -16.0}});
  test::Noise random(seed);
  for (Index i = 0; i < depth.grid.size(); ++i) {
    const Point p = depth.grid.centre(i);
    const double v = -std::sin(a) * (p.x - 0.7) + std::cos(a) * (p.y - 1.1);
    const double line = 12.0 * std::sqrt(2.0 * std::numbers::pi) * kSigma * std::exp(-0.5 * v * v / (kSigma * kSigma));
    depth.values[static_cast<std::size_t>(i)] = line / 0.5 + noise * random() + 2.0 + 0.3 * p.x;
  }
  return depth;
}

HeightMap flat(HeightMap depth) {
  for (Index i = 0; i < depth.grid.size(); ++i)
    depth.values[static_cast<std::size_t>(i)] -= 2.0 + 0.3 * depth.grid.centre(i).x;
  return depth;
}

TEST(FitTrenchDirection, FindsItWithinItsError) {
  for (const double direction : {25.0, -63.0, 0.0, 90.0, 141.0}) {
    double squares = 0.0;
    constexpr int kTrials = 12;
    for (int k = 0; k < kTrials; ++k) {
      const auto fitted = fit_trench_direction(flat(gaussian_trench(direction, 2.0, 100 + k)));
      ASSERT_TRUE(fitted.has_value()) << direction;
      EXPECT_LE(angle_between_tracks(fitted->degrees, direction), 0.2);
      EXPECT_GT(fitted->standard_error, 0.0);
      squares += std::pow(angle_between_tracks(fitted->degrees, direction) / fitted->standard_error, 2) / kTrials;
    }
    EXPECT_LE(std::sqrt(squares), 2.5) << direction << ": the stated error is that of the scatter";
  }
}

TEST(FitTrenchDirection, SaysNothingOfARoundSpot) {
  HeightMap spot(Grid{80, 90, 0.25, 0.25, {-11.0, -10.0}});
  for (Index i = 0; i < spot.grid.size(); ++i) {
    const Point p = spot.grid.centre(i);
    spot.values[static_cast<std::size_t>(i)] = 40.0 * std::exp(-0.3 * p.x * p.x - 0.25 * p.y * p.y);
  }
  EXPECT_FALSE(fit_trench_direction(spot).has_value());
}

TEST(AngleBetweenTracks, KnowsNoSense) {
  EXPECT_NEAR(angle_between_tracks(10.0, 190.0), 0.0, 1e-12);
  EXPECT_NEAR(angle_between_tracks(-85.0, 85.0), 10.0, 1e-12);
  EXPECT_NEAR(angle_between_tracks(0.0, 90.0), 90.0, 1e-12);
}

TEST(CalibrateTrench, TakesTheFittedDirectionAndRefusesOneThatDisagrees) {
  const HeightMap depth = gaussian_trench(25.0, 1.0, 5);
  TrenchOptions options;
  options.feed = 0.5;
  const TrenchCalibration fitted = calibrate_trench(depth, options);
  EXPECT_NEAR(fitted.direction, 25.0, 0.2);
  EXPECT_NEAR(fitted.profile(0.0), 12.0, 0.4);
  EXPECT_NEAR(fitted.profile(2.0), 12.0 * std::exp(-0.5 * 4.0 / (kSigma * kSigma)), 0.3);
  EXPECT_LE(fitted.asymmetry, 0.02);
  for (const double given : {0.0, 90.0, 22.0, -25.0}) {
    options.direction = given;
    test::expect_input_error([&] { calibrate_trench(depth, options); },
                             {"`direction` =", "runs at 2", "+-", "at most"});
  }
  options.direction = 205.2;
  EXPECT_EQ(calibrate_trench(depth, options).direction, 205.2);
}

// Within what is accepted too: the sections of both halves of the stretch are off the middle, each to its side.
TEST(CalibrateTrench, ShowsAWrongDirectionAsAsymmetry) {
  const HeightMap depth = gaussian_trench(25.0, 0.1, 6);
  TrenchOptions options;
  options.feed = 0.5;
  const double right = calibrate_trench(depth, options).asymmetry;
  options.direction = 25.4;
  EXPECT_GE(calibrate_trench(depth, options).asymmetry, 5.0 * right);
}

}  // namespace
}  // namespace dwell
