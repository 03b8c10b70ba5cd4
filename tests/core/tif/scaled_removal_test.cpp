#include "core/tif/scaled_removal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/tif/removal_kernel.h"

namespace dwell {
namespace {

/// Rates of a lopsided tool, on pixels that are not square and not about the axis.
RemovalFunction lopsided() {
  HeightMap rates(Grid{31, 41, 0.2, 0.25, {-3.8, -3.5}});
  for (Index i = 0; i < rates.grid.size(); ++i) {
    const Point p = rates.grid.centre(i);
    rates.values[static_cast<std::size_t>(i)] =
        5.0 * std::exp(-p.x * p.x / 2.0 - p.y * p.y / 1.2) * (1.0 + 0.3 * std::tanh(p.x));
  }
  TifCentre centre;
  centre.kind = TifCentre::Kind::Given;
  return measured_removal(rates, centre);
}

TEST(ScaledRemoval, TakesTheRateOfTheToolAtItsOwnPlaces) {
  for (const RemovalFunction& tif : {gaussian_removal(3.0, 2.0, 4.0), lopsided()}) {
    const RemovalFunction scaled = scaled_removal(tif, 1.3, 1.25);
    EXPECT_NEAR(scaled.volume, 1.3 * tif.volume, 1e-12 * tif.volume);
    EXPECT_NEAR(scaled.peak, 1.3 / 1.5625 * tif.peak, 1e-12);
    EXPECT_NEAR(scaled.fwhm, 1.25 * tif.fwhm, 1e-12);
    EXPECT_NEAR(scaled.radius, 1.25 * tif.radius, 1e-12);
    const auto before = rate_at_pixel(tif, 0.1, 0.1), after = rate_at_pixel(scaled, 0.1, 0.1);
    for (const Point p : {Point{0.3, -0.4}, Point{-0.8, 0.2}, Point{1.1, 0.9}})
      EXPECT_NEAR(after(1.25 * p), 1.3 / 1.5625 * before(p), 1e-9) << p.x;
  }
}

TEST(ScaledRemoval, ScalesADiscByItsSlope) {
  const RemovalFunction disc = spinning_disc_removal(2.0, 3.0), scaled = scaled_removal(disc, 0.8, 1.5);
  const RemovalFunction same = spinning_disc_removal(2.0 * 0.8 / std::pow(1.5, 3), 4.5);
  EXPECT_NEAR(scaled.slope, same.slope, 1e-12);
  EXPECT_NEAR(scaled.volume, same.volume, 1e-9 * same.volume);
  EXPECT_NEAR(scaled.peak, same.peak, 1e-12);
}

TEST(ScaledRemoval, RefusesFactorsThatAreNone) {
  const RemovalFunction tif = gaussian_removal(3.0, 2.0, 4.0);
  for (const double factor : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(scaled_removal(tif, factor, 1.0), std::invalid_argument);
    EXPECT_THROW(scaled_removal(tif, 1.0, factor), std::invalid_argument);
  }
}

}  // namespace
}  // namespace dwell
