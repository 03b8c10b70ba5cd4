#include "core/tif/removal_kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

/// Sum over the whole lattice displaced by (fx, fy) pixels times the pixel area. B-splines sum to one, so it is the
/// volume of the kernel for any displacement.
double lattice_volume(const RemovalKernel& k, double hx, double hy, double fx, double fy) {
  double sum = 0.0;
  for (Index r = -k.half_rows - 3; r <= k.half_rows + 3; ++r) {
    for (Index c = -k.half_cols - 3; c <= k.half_cols + 3; ++c)
      sum += k.rate({hx * (static_cast<double>(c) + fx), hy * (static_cast<double>(r) + fy)});
  }
  return sum * hx * hy;
}

double gaussian(double r) { return 2.0 * std::exp(-4.0 * std::log(2.0) * r * r / 9.0); }  // peak 2, FWHM 3

/// Samples of the Gaussian at a pitch, as if measured.
RemovalFunction measured_gaussian(double pitch) {
  const auto half = static_cast<Index>(std::lround(8.0 / pitch));
  const double edge = -pitch * static_cast<double>(half);
  HeightMap rates(Grid{2 * half + 1, 2 * half + 1, pitch, pitch, {edge, edge}});
  for (Index i = 0; i < rates.grid.size(); ++i)
    rates.values[static_cast<std::size_t>(i)] = gaussian(length(rates.grid.centre(i)));
  return measured_removal(rates, {TifCentre::Kind::Middle, {}});
}

void expect_volume(const RemovalFunction& tif, double hx, double hy) {
  const RemovalKernel k = removal_kernel(tif, hx, hy);
  for (const auto& [fx, fy] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.31, -0.44}}) {
    // The ring of zeros cuts the spline's ringing where the samples end in a jump: 0.27^4 of the edge samples.
    EXPECT_NEAR(lattice_volume(k, hx, hy, fx, fy), tif.volume, 2e-3 * tif.volume) << hx << " " << hy;
  }
  double sum = 0.0, energy = 0.0;
  for (Index r = -k.half_rows; r <= k.half_rows; ++r) {
    for (Index c = -k.half_cols; c <= k.half_cols; ++c) {
      const double v = k.rate({hx * static_cast<double>(c), hy * static_cast<double>(r)});
      sum += v;
      energy += v * v;
    }
  }
  EXPECT_NEAR(sum * hx * hy, tif.volume, 1e-10 * tif.volume);
  EXPECT_NEAR(k.energy, energy, 1e-10 * energy);
}

TEST(RemovalKernel, KeepsTheVolume) {
  for (const auto& [hx, hy] : {std::pair{0.2, 0.2}, {0.5, 0.3}, {1.1, 1.4}}) {
    expect_volume(gaussian_removal(2.0, 3.0, 7.0), hx, hy);
    expect_volume(spinning_disc_removal(0.5, 3.0), hx, hy);
    expect_volume(measured_gaussian(0.25), hx, hy);
  }
}

TEST(RemovalKernel, TakesAGaussianAtThePixelsAndBetween) {
  const RemovalKernel k = removal_kernel(gaussian_removal(2.0, 3.0, 9.0), 0.2, 0.25);
  EXPECT_NEAR(k.volume_factor, 1.0, 1e-6);
  for (double x : {0.0, 0.4, 1.0, 2.2}) {
    EXPECT_NEAR(k.rate({x, 0.5}), gaussian(std::hypot(x, 0.5)), 1e-6);
    EXPECT_NEAR(k.rate({x + 0.07, 0.41}), gaussian(std::hypot(x + 0.07, 0.41)), 1e-4);
  }
}

// A spline through samples h apart is within (5/384) h^4 |f''''| on an axis; |f''''| = 3 peak / sigma^4 at the axis.
TEST(RemovalKernel, ResamplesCoarseToFineAndFineToCoarse) {
  const double sigma = 3.0 / std::sqrt(8.0 * std::log(2.0));
  for (const auto& [measured, pitch] : {std::pair{0.5, 0.2}, {0.1, 0.5}, {0.25, 0.25}, {0.5, 0.37}}) {
    const double h = std::max(measured, pitch);
    const double tolerance = 1e-6 + 4.0 * 5.0 / 384.0 * std::pow(h / sigma, 4) * 3.0 * 2.0;
    const RemovalKernel k = removal_kernel(measured_gaussian(measured), pitch, pitch);
    EXPECT_NEAR(k.volume_factor, 1.0, 1e-3);
    for (double x = -5.0; x <= 5.0; x += 0.43) {
      EXPECT_NEAR(k.rate({x, 0.3}), gaussian(std::hypot(x, 0.3)), tolerance) << measured << " " << pitch;
    }
  }
}

TEST(RemovalKernel, PutsTheAxisOnASample) {
  const RemovalKernel k = removal_kernel(gaussian_removal(2.0, 3.0, 7.0), 0.1, 0.3);
  const Grid& g = k.surface.grid();
  ASSERT_EQ(g.rows, 2 * k.half_rows + 1);
  ASSERT_EQ(g.cols, 2 * k.half_cols + 1);
  EXPECT_NEAR(g.x(k.half_cols), 0.0, 1e-12);
  EXPECT_NEAR(g.y(k.half_rows), 0.0, 1e-12);
  EXPECT_GE(static_cast<double>(k.half_cols - SplineSurface::kMargin) * 0.1, 7.0 - 1e-6);
  EXPECT_NEAR(k.rate({0.0, 0.0}), 2.0 * k.volume_factor, 1e-12);
  // Symmetric about the axis to rounding; the coefficients are those of a symmetric function.
  const auto& c = k.surface.coefficients();
  for (std::size_t i = 0; i < c.size(); ++i) ASSERT_NEAR(c[i], c[c.size() - 1 - i], 1e-14);
}

TEST(RemovalKernel, KeepsTheHandednessOfAMeasuredSpot) {
  HeightMap rates(Grid{9, 9, 1.0, 1.0, {-4.0, -4.0}}, std::vector<double>(81, 0.0));
  for (Index r = 3; r < 8; ++r) {
    for (Index c = 4; c < 9; ++c) rates.at(r, c) = 1.0 + static_cast<double>(c);
  }
  const RemovalKernel k = removal_kernel(measured_removal(rates, {}), 1.0, 1.0);
  EXPECT_NEAR(k.volume_factor, 1.0, 1e-12);
  for (Index r = 0; r < 9; ++r) {
    for (Index c = 0; c < 9; ++c) {
      EXPECT_NEAR(k.rate({static_cast<double>(c - 4), static_cast<double>(r - 4)}), rates.at(r, c), 1e-12);
    }
  }
}

TEST(RemovalKernel, RefusesARemovalFunctionTooNarrowForTheMap) {
  const RemovalFunction tif = gaussian_removal(2.0, 3.0, 7.0);
  EXPECT_NO_THROW(removal_kernel(tif, 1.5, 1.5));
  expect_input_error([&] { removal_kernel(tif, 1.51, 1.0); }, {"FWHM = 3 mm", "two pixels", "1.51 x 1"});
  expect_input_error([&] { removal_kernel(tif, 1.0, 1.51); }, {"FWHM = 3 mm", "1 x 1.51"});
  expect_input_error([&] { removal_kernel(tif, std::nan(""), 1.0); }, {"two pixels"});
}

// A ring one sample wide, missed by the lattice of the map: the width is that of its area, but the samples see nothing.
TEST(RemovalKernel, RefusesAMapTooCoarseForTheVolume) {
  HeightMap rates(Grid{41, 41, 0.25, 0.25, {-5.0, -5.0}}, std::vector<double>(1681, 0.0));
  for (Index r = 0; r < 41; ++r) {
    for (Index c = 0; c < 41; ++c) {
      const bool on_stripe = c % 8 == 2 || c % 8 == 1 || c % 8 == 3;
      rates.at(r, c) = on_stripe ? 1.0 : 0.0;
    }
  }
  expect_input_error([&] { removal_kernel(measured_removal(rates, {}), 1.0, 1.0); }, {"volume", "too coarse"});
}

}  // namespace
}  // namespace dwell
