#include "core/tif/removal_orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/tif/removal_kernel.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using Flip = ToolOrientation::Flip;

double gauss(double x, double y, double sigma) { return std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)); }

/// A lobe to +x and a smaller one to +y: no symmetry at all.
double rate(Point p) {
  return 10.0 * gauss(p.x, p.y, 0.8) + 6.0 * gauss(p.x - 1.6, p.y, 0.6) + 3.0 * gauss(p.x + 0.3, p.y - 1.9, 0.6);
}

/// On a grid that is not square, of unequal pitches, not symmetric about the axis.
RemovalFunction spot() {
  HeightMap rates(Grid{61, 81, 0.125, 0.15, {-4.5, -4.2}});
  for (Index i = 0; i < rates.grid.size(); ++i) rates.values[static_cast<std::size_t>(i)] = rate(rates.grid.centre(i));
  return measured_removal(rates, {TifCentre::Kind::Given, {}});
}

/// Where the point of the unturned tool is that comes to lie at p.
Point before(Point p, const ToolOrientation& o) {
  const double a = o.angle * std::numbers::pi / 180.0;
  Point q{std::cos(a) * p.x + std::sin(a) * p.y, std::cos(a) * p.y - std::sin(a) * p.x};
  if (o.flip == Flip::X) q.x = -q.x;
  if (o.flip == Flip::Y) q.y = -q.y;
  return q;
}

TEST(Oriented, ActsWhereTheTurnedToolIs) {
  for (const Flip flip : {Flip::None, Flip::X, Flip::Y}) {
    for (const double angle : {0.0, 90.0, 180.0, 270.0, -90.0, 360.0, 37.0, -211.5}) {
      const ToolOrientation o{angle, flip};
      const RemovalFunction tif = oriented(spot(), o);
      const auto at = rate_at_pixel(tif, 0.1, 0.1);
      // Up to the samples' own interpolation error: a third of a sigma apart.
      for (const Point p : {Point{1.6, 0.0}, {0.0, 1.6}, {-1.6, 0.1}, {0.2, -1.7}, {1.0, 1.1}, {-2.0, 0.9}}) {
        EXPECT_NEAR(at(p), rate(before(p, o)), 0.02) << angle << " flip " << static_cast<int>(flip) << " at " << p.x;
      }
      EXPECT_NEAR(tif.volume, spot().volume, 1e-9 * tif.volume);
    }
  }
}

TEST(Oriented, MovesSamplesAsTheyAreForQuarterTurns) {
  const RemovalFunction tif = spot();
  const RemovalFunction quarter = oriented(tif, {90.0, Flip::None});
  ASSERT_EQ(quarter.samples.grid.rows, 81);
  ASSERT_EQ(quarter.samples.grid.cols, 61);
  for (Index r = 0; r < 61; ++r) {
    for (Index c = 0; c < 81; ++c) {
      EXPECT_EQ(quarter.samples.at(c, 60 - r), tif.samples.at(r, c));
      EXPECT_NEAR(quarter.samples.grid.x(60 - r), -tif.samples.grid.y(r), 1e-12);
      EXPECT_NEAR(quarter.samples.grid.y(c), tif.samples.grid.x(c), 1e-12);
    }
  }
  RemovalFunction round = tif;
  for (int k = 0; k < 4; ++k) round = oriented(round, {90.0, Flip::None});
  EXPECT_EQ(round.samples.values, tif.samples.values);
  EXPECT_EQ(oriented(tif, {0.0, Flip::None}).samples.values, tif.samples.values);
}

TEST(Oriented, DoesNotGrowWhereTheSplineRings) {
  HeightMap rates = spot().samples;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    if (length(rates.grid.centre(i)) > 3.0) rates.values[static_cast<std::size_t>(i)] = 0.0;
  }
  const RemovalFunction tif = measured_removal(rates, {TifCentre::Kind::Given, {}});
  EXPECT_LE(tif.radius, 3.0);
  EXPECT_LE(oriented(tif, {45.0, Flip::None}).radius, 3.0 + 2.0 * 0.15);
}

TEST(Oriented, LeavesRoundToolsAlone) {
  EXPECT_EQ(kind_of(oriented(gaussian_removal(1.0, 2.0, 3.0), {45.0, Flip::X})), "gaussian");
  test::expect_input_error([] { parse_flip("z"); }, {"'z'", "none, x, y"});
}

}  // namespace
}  // namespace dwell
