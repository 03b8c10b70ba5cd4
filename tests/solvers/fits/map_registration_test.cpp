#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/grid_limit.h"
#include "core/map/map_arithmetic.h"
#include "core/map/map_warp.h"
#include "solvers/fits/ceres_map_registration.h"
#include "tests/core/base/expect_error.h"
#include "tests/core/map/uneven_map.h"
#include "tests/core/tif/calibration/spot_truth.h"

namespace dwell {
namespace {

using test::expect_input_error;
using test::kNoData;
using test::map_of;

/// A surface without symmetry, waves of 8 to 25 mm.
double surface(double x, double y) {
  return 60.0 * std::sin(0.31 * x + 0.2 * y) + 45.0 * std::cos(0.52 * y - 0.11 * x + 1.0) + 0.4 * x * y +
         25.0 * std::sin(0.7 * x - 0.3) * std::cos(0.45 * y);
}

const Grid kFixed{70, 100, 0.4, 0.45, {-18.0, -14.0}};
const Grid kMoving{64, 96, 0.37, 0.5, {-16.0, -17.0}};

/// The surface as an instrument sees it whose part lies moved back by `transform`: moving(p) = surface(transform(p)).
HeightMap moved(const PlaneTransform& transform, double piston = 0.0, double tilt = 0.0) {
  HeightMap map = map_of(kMoving, [&](double x, double y) {
    const Point p = transform({x, y});
    return surface(p.x, p.y) + piston + tilt * x;
  });
  for (Index r = 20; r < 27; ++r) {
    for (Index c = 30; c < 41; ++c) map.at(r, c) = kNoData;
  }
  return map;
}

HeightMap fixed_map() {
  HeightMap map = map_of(kFixed, surface);
  for (Index r = 44; r < 52; ++r) {
    for (Index c = 60; c < 66; ++c) map.at(r, c) = kNoData;
  }
  for (Index r = 0; r < 9; ++r) map.at(r, 3) = kNoData;
  return map;
}

TEST(RegisterMaps, RecoversShiftRotationAndScaleOfMapsWithHoles) {
  for (const auto& [shift, degrees, scale] :
       {std::tuple{Point{1.37, -2.21}, 3.3, 1.012}, {Point{-3.05, 0.4}, -2.6, 0.985}, {Point{0.05, 0.02}, 0.1, 1.0}}) {
    const PlaneTransform truth = similarity(middle_of(kMoving), shift, degrees, scale);
    RegistrationOptions options;
    options.scale = true;
    options.range = {4.0, 4.0};
    const MapRegistration found = register_maps(moved(truth, 900.0, 3.0), fixed_map(), options, 2);
    // A few thousandths of the pitch: what cubic splines leave of waves of 20 pixels.
    EXPECT_NEAR(found.x.value, shift.x, 1e-3);
    EXPECT_NEAR(found.y.value, shift.y, 1e-3);
    EXPECT_NEAR(found.degrees.value, degrees, 2e-3);
    EXPECT_NEAR(found.scale.value, scale, 1e-4);
    for (const Point p : {Point{-15.0, -10.0}, Point{12.0, 8.0}})
      EXPECT_LE(distance(found.transform(p), truth(p)), 2e-3);
    EXPECT_LE(found.after.rms, 0.05);
    EXPECT_GT(found.before.rms, 5.0 * length(shift));
    EXPECT_GT(found.points, 3000);
  }
}

TEST(RegisterMaps, DustDoesNotPullAndTheErrorsAreThoseOfTheNoise) {
  const Point shift{0.83, -0.57};
  const PlaneTransform truth = similarity(middle_of(kMoving), shift, 1.2, 1.0);
  double sum_square_x = 0.0, sum_square_turn = 0.0, error_x = 0.0, error_turn = 0.0;
  constexpr int kRuns = 24;
  unsigned state = 99u;
  const auto uniform = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / 16777216.0 - 0.5;
  };
  for (int run = 0; run < kRuns; ++run) {
    HeightMap fixed = fixed_map();
    for (double& v : fixed.values) v += 2.0 * std::sqrt(12.0 / 3.0) * (uniform() + uniform() + uniform());
    for (Index r = 30; r < 36; ++r) {
      for (Index c = 20; c < 30; ++c) fixed.at(r, c) += 4000.0;
    }
    RegistrationOptions options;
    options.range = {1.5, 2.0};
    const MapRegistration found = register_maps(moved(truth), fixed, options, 2);
    EXPECT_EQ(found.scale.value, 1.0);
    EXPECT_EQ(found.scale.error, 0.0);
    sum_square_x += std::pow(found.x.value - shift.x, 2);
    sum_square_turn += std::pow(found.degrees.value - 1.2, 2);
    error_x += found.x.error / kRuns;
    error_turn += found.degrees.error / kRuns;
  }
  // Noise of 2 nm standard deviation on some 5,000 pixels. The spread of 24 runs is known to 15 %.
  const double spread_x = std::sqrt(sum_square_x / kRuns), spread_turn = std::sqrt(sum_square_turn / kRuns);
  EXPECT_LE(spread_x, 0.005);
  EXPECT_NEAR(error_x / spread_x, 1.0, 0.5);
  EXPECT_NEAR(error_turn / spread_turn, 1.0, 0.5);
}

/// A share of the pixels at fixed places raised by `height`.
void sprinkle(HeightMap& map, double share, double height, unsigned state) {
  for (double& v : map.values) {
    state = state * 1664525u + 1013904223u;
    if (static_cast<double>(state >> 8) / 16777216.0 < share) v += height;
  }
}

// 40 nm of surface with 0.2 nm of noise under dust of single pixels, in the map that moves, the other or both.
TEST(RegisterMaps, DustInEitherMapDoesNotMoveThem) {
  const Grid grid{121, 161, 0.1, 0.11, {-8.0, -6.5}};
  const auto wavy = [](double x, double y) {
    return 40.0 * std::sin(1.1 * x + 0.3) * std::cos(0.7 * y) + 15.0 * std::sin(2.3 * x + 1.7 * y) + 0.5 * x * y;
  };
  const Point shift{-0.365, 0.228};
  const PlaneTransform truth = similarity(middle_of(grid), shift, -1.3, 1.0);
  HeightMap clean_moving = map_of(grid, [&](double x, double y) {
    const Point p = truth({x, y});
    return wavy(p.x, p.y) + 3.0 + 0.1 * x;
  });
  HeightMap clean_fixed = map_of(grid, wavy);
  test::Noise noise(7);
  for (HeightMap* map : {&clean_moving, &clean_fixed}) {
    for (double& v : map->values) v += 0.2 * noise();
  }
  RegistrationOptions options;
  options.range = {1.6, 3.0};
  for (const auto& [share, height] : {std::pair{0.01, 50.0}, {0.01, 500.0}, {0.002, 500.0}, {0.002, -5000.0}}) {
    for (const auto& [dirty_moving, dirty_fixed] : {std::pair{true, false}, {false, true}, {true, true}}) {
      SCOPED_TRACE(testing::Message() << share << " of " << height << " nm " << dirty_moving << dirty_fixed);
      HeightMap moving = clean_moving, fixed = clean_fixed;
      if (dirty_moving) sprinkle(moving, share, height, 11u);
      if (dirty_fixed) sprinkle(fixed, share, height, 5u);
      const MapRegistration found = register_maps(moving, fixed, options, 2);
      EXPECT_NEAR(found.x.value, shift.x, 0.003);
      EXPECT_NEAR(found.y.value, shift.y, 0.003);
      EXPECT_NEAR(found.degrees.value, -1.3, 0.01);
      EXPECT_NEAR(found.after.scatter, 0.27, 0.05);  // both maps' noise, the moving one's less by interpolation
      EXPECT_GT(found.before.scatter, 5.0);
      const double dust = share * static_cast<double>(grid.size());
      EXPECT_NEAR(static_cast<double>(found.spikes_moving), dirty_moving ? dust : 0.0, 0.35 * dust);
      EXPECT_NEAR(static_cast<double>(found.spikes_fixed), dirty_fixed ? dust : 0.0, 0.35 * dust);
    }
  }
}

TEST(RegisterMaps, NarrowPeaksAndQuantisedHeightsAreNoSpikes) {
  // Peaks of three pixels at half height on the surface; then the surface in steps of an eighth of its scatter,
  // which lock onto the pixels: only that none is left out counts there.
  const Grid grid{60, 81, 0.4, 0.45, {-16.0, -13.0}};
  const PlaneTransform truth = similarity(middle_of(grid), {0.31, -0.53}, 0.8, 1.0);
  const auto peaks = [](double x, double y) {
    double sum = 0.1 * surface(x, y);
    for (const Point p : {Point{-9.0, -7.1}, {4.3, 6.2}, {8.1, -3.3}, {-5.2, 8.4}})
      sum += 100.0 * std::exp2(-4.0 * (std::pow(x - p.x, 2) + std::pow(y - p.y, 2)) / (1.35 * 1.35));
    return sum;
  };
  const auto steps = [](double x, double y) { return 8.0 * std::round(surface(x, y) / 8.0); };
  RegistrationOptions options;
  options.range = {1.0, 2.0};
  for (const bool stepped : {false, true}) {
    const auto height = [&](double x, double y) { return stepped ? steps(x, y) : peaks(x, y); };
    const HeightMap moving = map_of(grid, [&](double x, double y) {
      const Point p = truth({x, y});
      return height(p.x, p.y);
    });
    const MapRegistration found = register_maps(moving, map_of(grid, height), options, 2);
    EXPECT_EQ(found.spikes_moving, 0) << stepped;
    EXPECT_EQ(found.spikes_fixed, 0) << stepped;
    if (stepped) continue;
    EXPECT_NEAR(found.x.value, 0.31, 0.002);
    EXPECT_NEAR(found.y.value, -0.53, 0.002);
  }
}

TEST(RegisterMaps, WhatIsSubtractedAfterRegistrationIsGone) {
  const PlaneTransform truth = similarity(middle_of(kMoving), {0.9, 1.1}, -1.7, 1.0);
  RegistrationOptions options;
  options.range = {2.0, 3.0};
  const HeightMap moving = moved(truth), fixed = fixed_map();
  const MapRegistration found = register_maps(moving, fixed, options);
  const HeightMap left = difference(fixed, warp_map(moving, found.transform, fixed.grid));
  double worst = 0.0;
  for (const Index i : finite_pixels(left)) worst = std::max(worst, std::abs(left.values[static_cast<std::size_t>(i)]));
  EXPECT_GT(left.valid_pixels(), 3500);
  EXPECT_LE(worst, 1.5);  // of 150 nm; at the edges of holes, where the spline continues linearly
}

TEST(RegisterMaps, StopsWhereverItIsTold) {
  const HeightMap moving = moved(similarity(middle_of(kMoving), {0.9, 1.1}, -1.7, 1.0)), fixed = fixed_map();
  RegistrationOptions options;
  options.range = {2.0, 3.0};
  int all = 0;
  Progress counting;
  counting.stop = [&all] { return ++all < 0; };
  register_maps(moving, fixed, options, 1, counting);
  ASSERT_GT(all, 8);
  for (const int at : {1, all / 3, all / 2, all}) {
    int asked = 0;
    Progress progress;
    progress.stop = [&asked, at] { return ++asked >= at; };
    EXPECT_THROW(register_maps(moving, fixed, options, 1, progress), Interrupted) << at;
  }
}

TEST(RegisterMaps, SaysWhatKeepsItFromRegistering) {
  const HeightMap fixed = fixed_map();
  RegistrationOptions options;
  HeightMap far = moved({});
  far.grid.origin.x += 500.0;
  expect_input_error([&] { register_maps(far, fixed, options); }, {"0 pixels", "overlap"});
  options.range = {5.0, 0.0};
  expect_input_error([&] { register_maps(far, fixed, options); }, {"less than 40 %", "5 mm"});
  options.range = {};
  const HeightMap flat = map_of(kMoving, [](double, double) { return 7.0; });
  expect_input_error([&] { register_maps(flat, map_of(kFixed, [](double, double) { return 5.0; }), options); },
                     {"do not say how they lie"});
  // Waves along x only: any shift in y fits.
  const auto waves = [](double x, double) { return 10.0 * std::sin(0.5 * x) + 5.0 * std::sin(0.31 * x); };
  options.rotation = false;
  expect_input_error([&] { register_maps(map_of(kMoving, waves), map_of(kFixed, waves), options); },
                     {"do not say how they lie"});
  EXPECT_THROW(register_maps(moved({}), fixed, options, 1, Progress{{}, [] { return true; }}), Interrupted);
}

}  // namespace
}  // namespace dwell
