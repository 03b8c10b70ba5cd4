#include "core/tif/removal_function.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/base/numbers.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Integral over the plane of a rate that depends on the radius only, up to `radius`: midpoint rule.
double volume_of(const std::function<double(double)>& rate, double radius) {
  constexpr int kSteps = 200'000;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double r = radius * (k + 0.5) / kSteps;
    sum += rate(r) * 2.0 * kPi * r;
  }
  return sum * radius / kSteps;
}

TEST(GaussianRemoval, HasThePeakWidthAndVolumeOfItsFormula) {
  for (double radius : {1.0, 3.0, 20.0}) {
    const RemovalFunction tif = gaussian_removal(2.5, 2.8, radius);
    EXPECT_EQ(tif.kind, RemovalFunction::Kind::Gaussian);
    EXPECT_EQ(tif.peak, 2.5);
    EXPECT_EQ(tif.fwhm, 2.8);
    EXPECT_EQ(tif.radius, radius);
    const auto rate = [&](double r) { return 2.5 * std::exp(-r * r / (2.0 * tif.sigma * tif.sigma)); };
    EXPECT_NEAR(rate(1.4), 1.25, 1e-13);  // half the peak at half the width
    EXPECT_NEAR(tif.volume, volume_of(rate, radius), 1e-8 * tif.volume);
  }
  const RemovalFunction wide = gaussian_removal(2.5, 2.8, 100.0);
  EXPECT_NEAR(wide.volume, 2.0 * kPi * 2.5 * wide.sigma * wide.sigma, 1e-12);
}

TEST(SpinningDisc, HasTheRateOfItsRimAndTheVolumeOfACone) {
  const RemovalFunction tif = spinning_disc_removal(0.5, 3.0);
  EXPECT_EQ(tif.kind, RemovalFunction::Kind::Disc);
  EXPECT_DOUBLE_EQ(tif.peak, 1.5);
  EXPECT_EQ(tif.radius, 3.0);
  EXPECT_NEAR(tif.volume, volume_of([](double r) { return 0.5 * r; }, 3.0), 1e-8 * tif.volume);
  const double area = volume_of([](double r) { return 0.5 * r >= 0.75 ? 1.0 : 0.0; }, 3.0);
  EXPECT_NEAR(tif.fwhm, 2.0 * std::sqrt(area / kPi), 1e-4);
}

TEST(RemovalFunction, NamesTheParameterOutOfRange) {
  for (double bad : {0.0, -1.0, kNaN, kInfinity}) {
    expect_input_error([&] { gaussian_removal(bad, 1.0, 1.0); }, {"removal function", "peak", "from 1e-0"});
    expect_input_error([&] { gaussian_removal(1.0, bad, 1.0); }, {"removal function", "fwhm", "from 1e-0"});
    expect_input_error([&] { gaussian_removal(1.0, 1.0, bad); }, {"removal function", "radius", "from 1e-0"});
    expect_input_error([&] { spinning_disc_removal(bad, 1.0); }, {"removal function", "slope", "> 0"});
    expect_input_error([&] { spinning_disc_removal(1.0, bad); }, {"removal function", "radius", "from 1e-06"});
  }
}

/// A spot that is far from symmetric: a sheared Gaussian with a tail, on unequal pitches, off zero.
HeightMap asymmetric_spot() {
  HeightMap rates(Grid{21, 31, 0.25, 0.4, {100.0, -50.0}});
  for (Index r = 0; r < 21; ++r) {
    for (Index c = 0; c < 31; ++c) {
      const double x = rates.grid.x(c) - 102.5, y = rates.grid.y(r) + 46.8;
      rates.at(r, c) = 3.0 * std::exp(-x * x - 0.4 * y * y - 0.5 * x * y) * (1.0 + 0.3 * std::max(0.0, x + y));
    }
  }
  return rates;
}

TEST(MeasuredRemoval, HasThePeakVolumeAndWidthOfItsSamples) {
  const HeightMap rates = asymmetric_spot();
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Middle, {}});
  EXPECT_EQ(tif.kind, RemovalFunction::Kind::Measured);
  double peak = 0.0, sum = 0.0;
  for (double v : rates.values) {
    peak = std::max(peak, v);
    sum += v;
  }
  long above = 0;
  for (double v : rates.values) above += v >= 0.5 * peak;
  EXPECT_EQ(tif.peak, peak);
  EXPECT_NEAR(tif.volume, sum * 0.25 * 0.4, 1e-12 * sum);
  EXPECT_NEAR(kPi / 4.0 * tif.fwhm * tif.fwhm, static_cast<double>(above) * 0.25 * 0.4, 1e-12);
  EXPECT_EQ(tif.samples.values, rates.values);
}

TEST(MeasuredRemoval, OfAFineGaussianIsTheGaussian) {
  const RemovalFunction formula = gaussian_removal(2.0, 3.0, 8.0);
  HeightMap rates(Grid{161, 161, 0.1, 0.1, {-8.0, -8.0}});
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const double r = length(rates.grid.centre(i));
    rates.values[static_cast<std::size_t>(i)] =
        r <= 8.0 ? 2.0 * std::exp(-0.5 * r * r / (formula.sigma * formula.sigma)) : 0.0;
  }
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Centroid, {}});
  EXPECT_NEAR(tif.peak, formula.peak, 1e-12);
  EXPECT_NEAR(tif.volume, formula.volume, 1e-8 * formula.volume);
  EXPECT_NEAR(tif.fwhm, formula.fwhm, 0.05);  // counted pixels: to half a pixel
  EXPECT_NEAR(tif.radius, 8.0, 1e-9);
}

TEST(MeasuredRemoval, IsPlacedAtItsMiddle) {
  const RemovalFunction tif = measured_removal(asymmetric_spot(), {TifCentre::Kind::Middle, {}});
  EXPECT_NEAR(tif.samples.grid.x(15), 0.0, 1e-12);
  EXPECT_NEAR(tif.samples.grid.y(10), 0.0, 1e-12);
}

TEST(MeasuredRemoval, IsPlacedBetweenSamplesWhereTheMiddleIsBetweenThem) {
  const HeightMap rates(Grid{2, 4, 1.0, 1.0, {0.0, 0.0}}, std::vector<double>(8, 1.0));
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Middle, {}});
  EXPECT_EQ(tif.samples.grid.origin, (Point{-1.5, -0.5}));
  EXPECT_EQ(tif.radius, 1.5);
}

TEST(MeasuredRemoval, IsPlacedAtAPointOfItsFile) {
  const HeightMap rates = asymmetric_spot();
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Given, {102.5, -46.8}});
  EXPECT_NEAR(tif.samples.grid.origin.x, -2.5, 1e-12);
  EXPECT_NEAR(tif.samples.grid.origin.y, -3.2, 1e-12);
  EXPECT_NEAR(tif.radius, 5.0, 1e-12);  // the last column, 107.5
}

TEST(MeasuredRemoval, IsPlacedAtItsCentroid) {
  const HeightMap rates = asymmetric_spot();
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Centroid, {}});
  double sum = 0.0, mx = 0.0, my = 0.0;
  for (Index r = 0; r < 21; ++r) {
    for (Index c = 0; c < 31; ++c) {
      sum += rates.at(r, c);
      mx += rates.at(r, c) * (100.0 + 0.25 * static_cast<double>(c));
      my += rates.at(r, c) * (-50.0 + 0.4 * static_cast<double>(r));
    }
  }
  EXPECT_NEAR(tif.samples.grid.origin.x, 100.0 - mx / sum, 1e-11);
  EXPECT_NEAR(tif.samples.grid.origin.y, -50.0 - my / sum, 1e-11);
  EXPECT_GT(std::abs(mx / sum - 103.75), 0.5) << "the spot must tell the centroid from the middle";
}

TEST(MeasuredRemoval, ReadsNoDataAsZero) {
  HeightMap rates = asymmetric_spot();
  HeightMap zeros = rates;
  for (std::size_t i : {0u, 40u, 200u, 210u, 650u}) {
    rates.values[i] = kNaN;
    zeros.values[i] = 0.0;
  }
  for (auto kind : {TifCentre::Kind::Centroid, TifCentre::Kind::Middle}) {
    const RemovalFunction a = measured_removal(rates, {kind, {}}), b = measured_removal(zeros, {kind, {}});
    EXPECT_EQ(a.samples.values, b.samples.values);
    EXPECT_EQ(a.samples.grid, b.samples.grid);
    EXPECT_EQ(a.peak, b.peak);
    EXPECT_EQ(a.volume, b.volume);
    EXPECT_EQ(a.fwhm, b.fwhm);
    EXPECT_EQ(a.radius, b.radius);
  }
}

TEST(MeasuredRemoval, ReachesToItsFarthestSampleThatRemoves) {
  HeightMap rates(Grid{5, 5, 1.0, 2.0, {-2.0, -4.0}}, std::vector<double>(25, 0.0));
  rates.at(2, 2) = 1.0;
  rates.at(2, 3) = 0.5;
  EXPECT_EQ(measured_removal(rates, {}).radius, 1.0);
  rates.at(1, 2) = 0.5;
  EXPECT_EQ(measured_removal(rates, {}).radius, 2.0);
  rates.at(0, 4) = -0.1;
  EXPECT_EQ(measured_removal(rates, {}).radius, 4.0);
}

TEST(MeasuredRemoval, IsRefusedWithoutRemoval) {
  const Grid grid{3, 3, 1.0, 1.0, {}};
  const auto of = [&](std::vector<double> values, TifCentre::Kind kind = TifCentre::Kind::Middle) {
    return [&grid, values, kind] { measured_removal(HeightMap(grid, values), {kind, {}}); };
  };
  expect_input_error(of(std::vector<double>(9, kNaN)), {"largest rate is 0"});
  expect_input_error(of(std::vector<double>(9, 0.0)), {"largest rate is 0"});
  expect_input_error(of(std::vector<double>(9, -1.0)), {"largest rate is -1"});
  const std::vector<double> mostly_negative = {1, -1, -1, 0, 0, 0, 0, 0, 0};
  expect_input_error(of(mostly_negative), {"volume rate is -1"});
  expect_input_error(of(mostly_negative, TifCentre::Kind::Centroid), {"sum to -1", "centroid"});
}

TEST(RemovalFunction, NamesItsKind) {
  EXPECT_EQ(kind_of(gaussian_removal(1.0, 1.0, 1.0)), "gaussian");
  EXPECT_EQ(kind_of(spinning_disc_removal(1.0, 1.0)), "disc");
  EXPECT_EQ(kind_of(measured_removal(asymmetric_spot(), {})), "measured");
}

}  // namespace
}  // namespace dwell
