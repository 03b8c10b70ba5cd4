#include "core/tif/calibration/spot_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "core/tif/calibration/spot_finder.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/tif/calibration/spot_truth.h"

namespace dwell {
namespace {

using test::after_spots;
using test::expect_input_error;
using test::Noise;
using test::tilted;
using test::tool_rate;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const Grid kGrid{150, 200, 0.1, 0.12, {-7.0, 4.0}};  // 20 x 18 mm
const std::vector<Point> kFour{{-2.03, 17.01}, {8.271, 16.53}, {-2.44, 8.6}, {8.02, 8.137}};

HeightMap depth_of(const HeightMap& after) {
  HeightMap depth = after;
  for (double& v : depth.values) v = -v;
  return depth;
}

SpotOptions options_for(double seconds) {
  SpotOptions options;
  options.dwell_time = seconds;
  return options;
}

/// Largest difference of the rates from the tool, whose axis is `axis` away from the calibrated one.
double worst(const HeightMap& rates, Point axis, double within) {
  double most = 0.0;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const Point d = rates.grid.centre(i);
    if (length(d) > within) continue;
    most = std::max(most, std::abs(rates.values[static_cast<std::size_t>(i)] - tool_rate(d - axis)));
  }
  return most;
}

double volume_of_tool() {
  double sum = 0.0;
  for (int r = -400; r <= 400; ++r) {
    for (int c = -400; c <= 400; ++c) sum += tool_rate({0.01 * c, 0.01 * r});
  }
  return sum * 1e-4;
}

TEST(FindSpots, FindsAllInOrderAndJoinsTheLobesOfOne) {
  const std::vector<FoundSpot> spots = find_spots(depth_of(after_spots(kGrid, kFour, 5.0, 0.2, 3)));
  ASSERT_EQ(spots.size(), 4u);
  for (const FoundSpot& s : spots) {
    double nearest = 1e9;
    for (const Point p : kFour) nearest = std::min(nearest, distance(s.centre, p + Point{0.4, 0.1}));
    EXPECT_LT(nearest, 0.4);
    EXPECT_GT(s.extent, 1.0);
    EXPECT_LT(s.extent, 2.2);
  }
  EXPECT_GT(spots[0].centre.y, spots[3].centre.y);
}

TEST(CalibrateSpots, RecoversAnAsymmetricToolAtAGivenAxis) {
  const HeightMap after = after_spots(kGrid, {{3.037, 12.551}}, 5.0, 0.0, 1);
  SpotOptions options = options_for(5.0);
  options.at = {{3.037, 12.551}};
  options.radius = 3.4;
  options.centre = SpotCentre::Given;
  options.noise_cut = 0.0;
  const SpotCalibration c = calibrate_spots(depth_of(after), options);
  EXPECT_EQ(c.rates.quantity, MapQuantity::Rate);
  EXPECT_LE(worst(c.rates, {}, 3.0), 1e-3 * 11.0);  // one spot is not resampled: the rest is the baseline's
  EXPECT_NEAR(c.spots[0].volume, volume_of_tool(), 2e-3 * volume_of_tool());
  EXPECT_NE(c.rates.history.back().find("given position"), std::string::npos);
}

TEST(CalibrateSpots, TakesTheDifferenceOfTwoMapsWhateverTheSurfaceWas) {
  HeightMap before(kGrid), after(kGrid);
  for (Index i = 0; i < kGrid.size(); ++i) {
    const Point p = kGrid.centre(i);
    const auto k = static_cast<std::size_t>(i);
    before.values[k] = 200.0 * std::sin(0.7 * p.x) * std::cos(0.5 * p.y);
    after.values[k] = before.values[k] - 4.0 * tool_rate(p - Point{3.0, 12.0}) + tilted(p);
  }
  SpotOptions options = options_for(4.0);
  options.at = {{3.0, 12.0}};
  options.centre = SpotCentre::Given;
  const SpotCalibration c = calibrate_spots(removed_depth(before, after), options);
  EXPECT_LE(worst(c.rates, {}, 2.5), 0.011 * 11.0);  // what the noise cut of 1 % took
  HeightMap shifted = before;
  shifted.grid.origin.x += 0.05;
  expect_input_error([&] { removed_depth(shifted, after); }, {"`before`", "150 x 200", "same grid"});
}

// Four spots at places that are not whole pixels apart: with the axes known, the mean must be the tool itself, and its
// noise half of that of one.
TEST(CalibrateSpots, AveragesSpotsAtSubPixelOffsets) {
  constexpr double kSeconds = 5.0, kNoise = 1.0;
  for (const auto how : {SpotRegistration::LeastSquares, SpotRegistration::Centroid}) {
    SpotOptions options = options_for(kSeconds);
    options.at = kFour;
    options.centre = SpotCentre::Given;
    options.registration = how;
    options.radius = 3.3;
    options.noise_cut = 0.0;
    const SpotCalibration clean = calibrate_spots(depth_of(after_spots(kGrid, kFour, kSeconds, 0.0, 1)), options);
    EXPECT_LE(worst(clean.rates, {}, 3.0), 0.01);
    for (std::size_t k = 1; k < 4; ++k) {
      const Point shift = clean.spots[k].position - clean.spots[0].position, truth = kFour[k] - kFour[0];
      EXPECT_LE(distance(shift, truth), 0.01 * kGrid.pitch_x) << k;  // a hundredth of a pixel
    }
    const SpotCalibration noisy = calibrate_spots(depth_of(after_spots(kGrid, kFour, kSeconds, kNoise, 7)), options);
    for (std::size_t k = 1; k < 4; ++k) {
      const Point shift = noisy.spots[k].position - noisy.spots[0].position, truth = kFour[k] - kFour[0];
      EXPECT_LE(distance(shift, truth), 0.1 * kGrid.pitch_x) << k;
    }
    double square = 0.0, deviation = 0.0;
    Index count = 0;
    for (Index i = 0; i < noisy.rates.grid.size(); ++i) {
      const Point d = noisy.rates.grid.centre(i);
      if (length(d) > 3.0) continue;
      square += std::pow(noisy.rates.values[static_cast<std::size_t>(i)] - tool_rate(d), 2);
      deviation += std::pow(noisy.deviation.values[static_cast<std::size_t>(i)], 2);
      ++count;
    }
    const double rms = std::sqrt(square / static_cast<double>(count)), one = kNoise / kSeconds;
    EXPECT_LE(rms, 0.75 * one);  // of four spots: 0.5, and what interpolation and baselines add
    EXPECT_GE(rms, 0.3 * one);
    EXPECT_NEAR(std::sqrt(deviation / static_cast<double>(count)), one, 0.25 * one);
    EXPECT_NEAR(noisy.spots[2].scatter, one, 0.1 * one);
  }
}

TEST(CalibrateSpots, FindsRadiusAndCentroidByItself) {
  const SpotCalibration c = calibrate_spots(depth_of(after_spots(kGrid, kFour, 5.0, 0.2, 11)), options_for(5.0));
  ASSERT_EQ(c.spots.size(), 4u);
  EXPECT_GT(c.radius, 2.4);
  EXPECT_LT(c.radius, 5.0);
  for (const CalibratedSpot& s : c.spots) EXPECT_NEAR(s.volume, volume_of_tool(), 0.02 * volume_of_tool());
  // Its axis is the centroid of what is above a tenth of the peak.
  double sum = 0.0;
  Point moment;
  for (Index i = 0; i < c.rates.grid.size(); ++i) {
    const double v = c.rates.values[static_cast<std::size_t>(i)] - 0.1 * c.spots[0].peak;
    if (v > 0.0) sum += v, moment = moment + v * c.rates.grid.centre(i);
  }
  EXPECT_LE(length((1.0 / sum) * moment), 0.02);
  EXPECT_LE(std::abs(c.volume_cut), 0.02);
}

TEST(CalibrateSpots, CentresOnThePeak) {
  HeightMap depth(kGrid);
  const Point peak{3.333, 12.777};
  for (Index i = 0; i < kGrid.size(); ++i) {
    const Point d = kGrid.centre(i) - peak;
    const double s = d.x < 0.0 ? 1.6 : 0.8;  // the centroid is 0.6 mm off the peak
    depth.values[static_cast<std::size_t>(i)] = 50.0 * std::exp(-0.5 * (d.x * d.x / (s * s) + d.y * d.y));
  }
  SpotOptions options = options_for(2.0);
  options.centre = SpotCentre::Peak;
  options.at = {peak};
  options.radius = 4.4;
  const SpotCalibration c = calibrate_spots(depth, options);
  const Point found = c.spots[0].position;
  const auto top = std::max_element(c.rates.values.begin(), c.rates.values.end()) - c.rates.values.begin();
  EXPECT_LE(length(c.rates.grid.centre(top)), 0.25);
  EXPECT_GT(distance(found, peak), 0.4) << "the spot must tell its peak from its centroid";
}

TEST(CalibrateSpots, CutsNoiseAndWhatIsBeyondTheRadius) {
  SpotOptions options = options_for(5.0);
  options.at = {{3.0, 12.0}};
  options.radius = 3.3;
  options.noise_sigmas = 3.0;
  const SpotCalibration c = calibrate_spots(depth_of(after_spots(kGrid, options.at, 5.0, 2.0, 5)), options);
  const double level = 3.0 * c.spots[0].scatter;
  for (const double v : c.rates.values) EXPECT_TRUE(v == 0.0 || v >= level) << v;
  Index beyond = 0;
  for (Index i = 0; i < c.rates.grid.size(); ++i) {
    if (length(c.rates.grid.centre(i)) > 3.4) beyond += c.rates.values[static_cast<std::size_t>(i)] != 0.0;
  }
  EXPECT_EQ(beyond, 0);
}

TEST(CalibrateSpots, FillsFewHolesAndRefusesMany) {
  HeightMap after = after_spots(kGrid, {{3.0, 12.0}}, 5.0, 0.0, 1);
  SpotOptions options = options_for(5.0);
  options.at = {{3.0, 12.0}};
  options.radius = 3.3;
  options.centre = SpotCentre::Given;
  options.noise_cut = 0.0;
  after.at(66, 99) = after.at(66, 100) = after.at(70, 108) = kNaN;
  const SpotCalibration c = calibrate_spots(depth_of(after), options);
  EXPECT_EQ(c.filled_pixels, 3);
  EXPECT_LE(worst(c.rates, {}, 3.0), 0.3);
  for (Index r = 60; r < 80; ++r) {
    for (Index col = 90; col < 102; ++col) after.at(r, col) = kNaN;
  }
  expect_input_error([&] { calibrate_spots(depth_of(after), options); }, {"spot at (3, 12)", "% of the pixels", "5 %"});
}

TEST(CalibrateSpots, RefusesASpotAtTheEdge) {
  const HeightMap depth = depth_of(after_spots(kGrid, {{-6.2, 12.0}}, 5.0, 0.0, 1));
  expect_input_error([&] { calibrate_spots(depth, options_for(5.0)); }, {"spot at (", "edge of the map", "`radius`"});
  SpotOptions options = options_for(5.0);
  options.at = {{-6.2, 12.0}};
  options.radius = 3.0;
  expect_input_error([&] { calibrate_spots(depth, options); }, {"spot at (-6.2, 12)", "off the map"});
  options.at = {{100.0, 100.0}};
  expect_input_error([&] { calibrate_spots(depth, options); }, {"spot at (100, 100)", "baseline"});
}

// With a radius the place is taken as given; the centroid then walks to the next spot.
TEST(CalibrateSpots, RefusesASpotFarFromThePlaceGiven) {
  const HeightMap depth = depth_of(after_spots(kGrid, {{-2.0, 10.0}, {6.1, 15.3}}, 5.0, 0.1, 1));
  // Above half the peak: 2 mm wide.
  SpotOptions options = options_for(5.0);
  options.radius = 3.0;
  options.at = {{-2.0, 10.0}, {6.1, 15.3}};
  const Point place = calibrate_spots(depth, options).spots[1].position;
  EXPECT_LE(distance(place, {6.1, 15.3}), 0.5);
  for (const Point off : {Point{0.9, 0.0}, {-0.6, 0.4}}) {
    options.at[1] = Point{6.1, 15.3} + off;
    const Point found = calibrate_spots(depth, options).spots[1].position;
    EXPECT_LE(distance(found, place), 0.01) << off.x;
  }
  options.at[1] = {6.1, 12.9};
  expect_input_error([&] { calibrate_spots(depth, options); }, {"`at` 6.1,12.9 (spot 2 of 2)", "is at (6.3", ", 15.3",
                                                                "2.4", "at most 1.1", "half of its width"});
  // Found by itself, too, where the nearest spot is not at the place.
  options.radius.reset();
  options.at = {{-2.0, 8.0}};
  expect_input_error([&] { calibrate_spots(depth, options); }, {"`at` -2,8 (spot 1 of 1)", "mm away"});
}

TEST(CalibrateSpots, RefusesBeforeAndAfterSwapped) {
  const HeightMap flat(kGrid, std::vector<double>(static_cast<std::size_t>(kGrid.size()), 0.0));
  const HeightMap after = after_spots(kGrid, kFour, 5.0, 0.1, 1);
  const HeightMap swapped = removed_depth(after, flat);
  expect_input_error([&] { calibrate_spots(swapped, options_for(5.0)); }, {"higher after than before", "swapped"});
  SpotOptions options = options_for(5.0);
  options.at = kFour;
  options.radius = 3.0;
  expect_input_error([&] { calibrate_spots(swapped, options); }, {"higher after than before", "swapped"});
}

TEST(CalibrateSpots, RefusesWhatItCannotUse) {
  const HeightMap depth = depth_of(after_spots(kGrid, kFour, 5.0, 0.1, 1));
  for (const double seconds : {0.0, -5.0, kNaN, HUGE_VAL}) {
    expect_input_error([&] { calibrate_spots(depth, options_for(seconds)); }, {"`dwell time` = ", "> 0"});
  }
  const auto with = [&](auto change) {
    return [&depth, change] {
      SpotOptions options = options_for(5.0);
      change(options);
      calibrate_spots(depth, options);
    };
  };
  expect_input_error(with([](auto& o) { o.radius = -1.0; }), {"`radius` = -1"});
  expect_input_error(with([](auto& o) { o.noise_cut = 0.9; }), {"`noise cut` = 0.9"});
  expect_input_error(with([](auto& o) { o.noise_cut = kNaN; }), {"`noise cut` = nan"});
  expect_input_error(with([](auto& o) { o.noise_sigmas = -1.0; }), {"`noise sigmas` = -1"});
  expect_input_error(with([](auto& o) { o.centre = SpotCentre::Given; }), {"`centre` at", "`at`"});
  expect_input_error(with([](auto& o) { o.at = {{3.0, 12.5}}; }), {"`at` 3,12.5", "no spot there"});
  expect_input_error(with([](auto& o) { o.at = {{3.0, 12.5}}, o.radius = 1e6; }), {"`radius` = 1e+06"});
  expect_input_error([] { calibrate_spots(HeightMap(kGrid), options_for(1.0)); }, {"0 pixels with data"});
  Noise random(5);
  HeightMap noise(kGrid);
  for (double& v : noise.values) v = random();
  expect_input_error([&] { calibrate_spots(noise, options_for(1.0)); }, {"no spot found", "scatter"});
}

TEST(CalibrateSpots, ReadsItsWords) {
  EXPECT_EQ(parse_spot_centre("peak"), SpotCentre::Peak);
  EXPECT_EQ(parse_spot_baseline("constant"), SpotBaseline::Constant);
  EXPECT_EQ(parse_spot_registration("centroid"), SpotRegistration::Centroid);
  expect_input_error([] { parse_spot_centre("top"); }, {"'top'", "centroid, peak, at"});
  expect_input_error([] { parse_spot_baseline("tilt"); }, {"'tilt'", "plane, constant, none"});
  expect_input_error([] { parse_spot_registration("x"); }, {"'x'", "centroid, least-squares"});
}

}  // namespace
}  // namespace dwell
