#include "core/tif/kernel_change.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/removal/coarse_removal.h"
#include "core/removal/removal_geometry.h"
#include "core/tif/scaled_removal.h"

namespace dwell {
namespace {

const RemovalFunction kTool = gaussian_removal(3.0, 4.0, 9.0);

double volume_of(const RemovalKernel& kernel) {
  const std::vector<double>& c = kernel.surface.coefficients();
  return std::accumulate(c.begin(), c.end(), 0.0);
}

TEST(KernelChange, IsTheDerivativeOfAGaussian) {
  const double sigma2 = 16.0 / (8.0 * std::log(2.0));
  for (const PixelDivision division : {PixelDivision{1, 1}, PixelDivision{2, 3}}) {
    const RemovalKernel kernel = pixel_kernel(kTool, 0.5, 0.4, division);
    const RemovalKernel by_width = kernel_by_width(kTool, kernel, 0.5, 0.4);
    const RemovalKernel by_x = kernel_by_shift(kernel, ShiftAxis::X), by_y = kernel_by_shift(kernel, ShiftAxis::Y);
    for (const Point p : {Point{0.0, 0.0}, Point{1.3, -0.4}, Point{-2.2, 1.7}, Point{0.35, 3.1}}) {
      const double q = dot(p, p) / sigma2, b = 3.0 * std::exp(-0.5 * q);
      // The kernel is the mean over a pixel: as of a tool a little wider.
      EXPECT_NEAR(by_width.rate(p), b * (q - 2.0), 0.03 * 3.0);
      EXPECT_NEAR(by_x.rate(p), -b * p.x / sigma2, 0.02 * 3.0);
      EXPECT_NEAR(by_y.rate(p), -b * p.y / sigma2, 0.02 * 3.0);
    }
    for (const RemovalKernel* change : {&by_width, &by_x, &by_y}) {
      EXPECT_NEAR(volume_of(*change), 0.0, 1e-3 * volume_of(kernel));
      EXPECT_EQ(change->division, division);
      EXPECT_GT(change->energy, 0.0);
    }
  }
}

TEST(KernelChange, OfAToolThatANarrowerOneWouldBeTooNarrowForIsOneSided) {
  const RemovalFunction narrow = gaussian_removal(3.0, 1.01, 2.5);
  const RemovalKernel kernel = pixel_kernel(narrow, 0.5, 0.5);
  EXPECT_NEAR(kernel_by_width(narrow, kernel, 0.5, 0.5).rate({}), -2.0 * kernel.rate({}), 0.6 * kernel.rate({}));
}

TEST(KernelChange, KeepsItsSizeOnACoarseLattice) {
  RemovalKernel kernel = pixel_kernel(gaussian_removal(3.0, 12.0, 27.0), 0.5, 0.5);
  kernel.coarse = {6, 6};
  const RemovalKernel change = kernel_by_shift(kernel, ShiftAxis::X);
  const HeightMap map(Grid{60, 80, 0.5, 0.5, {0.0, 0.0}}, std::vector<double>(4800, 0.0));
  const std::vector<Stroke> strokes{{{18.0, 14.0}, {18.2, 14.1}, {18.4, 14.2}},
                                    {{25.0, 9.0}, {25.0, 9.0}, {25.0, 9.0}}};
  const Eigen::Vector2d t(2.0, 3.0);
  Vector coarse, fine;
  RemovalGeometry g = removal_geometry(map.grid, finite_pixels(map), change, strokes, 1);
  make_removal_operator(g)->apply(t, coarse);
  g.kernel.coarse = {};
  make_removal_operator(g)->apply(t, fine);
  EXPECT_LE((coarse - fine).norm(), 0.01 * fine.norm());
}

TEST(KernelChange, TimesANumberIsScaled) {
  const RemovalKernel kernel = pixel_kernel(kTool, 0.5, 0.4), twice = times(kernel, -2.0);
  EXPECT_NEAR(twice.rate({1.0, 0.3}), -2.0 * kernel.rate({1.0, 0.3}), 1e-12);
  EXPECT_NEAR(twice.energy, 4.0 * kernel.energy, 1e-9);
}

}  // namespace
}  // namespace dwell
