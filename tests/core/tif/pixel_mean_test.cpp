#include "core/tif/pixel_mean.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/tif/removal_kernel.h"

namespace dwell {
namespace {

/// By n x n midpoints, of a rate at a point.
template <class Rate>
double mean_by_points(const Rate& rate, Point centre, double hx, double hy, int n) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) sum += rate(centre + Point{hx * ((j + 0.5) / n - 0.5), hy * ((i + 0.5) / n - 0.5)});
  }
  return sum / (n * n);
}

/// A lobe beside the axis on samples that are finer along x.
RemovalFunction measured_lobe() {
  HeightMap rates(Grid{25, 31, 0.2, 0.3, {-3.0, -3.6}});
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const Point p = rates.grid.centre(i) - Point{0.5, -0.3};
    rates.values[static_cast<std::size_t>(i)] = 4.0 * std::exp(-1.3 * p.x * p.x - 0.8 * p.y * p.y + 0.5 * p.x * p.y);
  }
  return measured_removal(rates, {TifCentre::Kind::Given, {}});
}

void expect_mean(const RemovalFunction& tif, double tolerance) {
  for (const auto& [hx, hy] : {std::pair{0.4, 0.4}, {0.7, 1.1}, {1.5, 0.3}}) {
    const auto mean = mean_rate_over_pixel(tif, hx, hy);
    for (const Point p : {Point{0.0, 0.0}, {0.1, -0.2}, {1.3, 0.4}, {-1.9, 0.7}, {0.3, 2.0}, {-1.5, -1.4}, {2.4, 2.4}})
      EXPECT_NEAR(mean(p), mean_by_points(rate_at_point(tif), p, hx, hy, 400), tolerance * tif.peak)
          << kind_of(tif) << " " << hx << " x " << hy << " at " << p.x << "," << p.y;
  }
}

// The cut-offs are jumps, which 400 points a side hold to about 1e-3 of a pixel's rim; smooth functions to 1e-6.
TEST(PixelMean, IsTheMeanOverManyPoints) {
  expect_mean(gaussian_removal(3.0, 2.0, 9.0), 2e-6);
  expect_mean(gaussian_removal(3.0, 2.0, 1.9), 5e-4);
  expect_mean(spinning_disc_removal(0.8, 2.0), 2e-3);
  expect_mean(measured_lobe(), 2e-6);
}

TEST(PixelMean, TilesToTheVolumeWhereverTheAxisLies) {
  for (const RemovalFunction& tif :
       {gaussian_removal(3.0, 2.0, 1.9), spinning_disc_removal(0.8, 2.0), measured_lobe()}) {
    const double hx = 0.7, hy = 0.45;
    const auto mean = mean_rate_over_pixel(tif, hx, hy);
    for (const Point shift : {Point{}, {0.31, 0.02}, {-0.2, 0.2}}) {
      double sum = 0.0;
      for (int r = -20; r <= 20; ++r) {
        for (int c = -20; c <= 20; ++c) sum += mean(shift + Point{c * hx, r * hy});
      }
      EXPECT_NEAR(sum * hx * hy, tif.volume, 2e-5 * tif.volume) << kind_of(tif);
    }
  }
}

TEST(PixelMean, IsZeroOutOfReach) {
  const auto mean = mean_rate_over_pixel(spinning_disc_removal(0.8, 2.0), 0.5, 0.5);
  EXPECT_EQ(mean({2.3, 0.0}), 0.0);
  EXPECT_EQ(mean({1.7, 1.7}), 0.0);
  EXPECT_GT(mean({2.2, 0.0}), 0.0);
}

// The finer the lattice, the nearer its spline is to the mean over the map's pixels; a disc's rim falls over one pixel.
TEST(PixelKernel, HoldsTheMeanBetterOnAFinerLattice) {
  const RemovalFunction disc = spinning_disc_removal(1.0, 4.2);
  const auto mean = mean_rate_over_pixel(disc, 2.0, 1.5);
  double before = 1e9;
  for (const Index parts : {1, 2, 4, 8}) {
    const RemovalKernel kernel = pixel_kernel(disc, 2.0, 1.5, {parts, parts});
    EXPECT_EQ(kernel.division, (PixelDivision{parts, parts}));
    EXPECT_NEAR(kernel.volume_factor, 1.0, 1e-5);
    double error = 0.0;
    for (double x = -5.5; x < 5.5; x += 0.237) {
      for (double y = -5.5; y < 5.5; y += 0.291) error += std::pow(kernel.rate({x, y}) - mean({x, y}), 2);
    }
    EXPECT_LT(error, 0.3 * before) << parts;
    before = error;
  }
}

TEST(PixelKernel, LeavesOutWhatIsNothing) {
  HeightMap rates(Grid{61, 61, 0.1, 0.1, {-3.0, -3.0}}, std::vector<double>(3721, 0.0));
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const double r = length(rates.grid.centre(i));
    if (r < 1.0) rates.values[static_cast<std::size_t>(i)] = 2.0 * (1.0 - r * r);
  }
  rates.at(0, 0) = 1e-9;  // a file may hold a wide rim of next to nothing
  const RemovalFunction tif = measured_removal(rates, {});
  const RemovalKernel kernel = pixel_kernel(tif, 0.1, 0.1);
  EXPECT_LT(kernel.half_rows, 30);
  EXPECT_NEAR(kernel.rate({0.35, -0.2}), mean_rate_over_pixel(tif, 0.1, 0.1)({0.35, -0.2}), 1e-4);
}

}  // namespace
}  // namespace dwell
