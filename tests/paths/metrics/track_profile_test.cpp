#include "paths/metrics/track_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

constexpr double kPi = std::numbers::pi;

/// Sum over a fine square grid of everything within half a cell of the line: shares nothing with the code but the rate.
double brute_force_line(const std::function<double(Point)>& rate, double angle_deg, double v, double reach, int cells) {
  const double a = angle_deg * kPi / 180.0, h = 2.0 * reach / cells;
  double sum = 0.0;
  for (int i = 0; i < cells; ++i) {
    const double u = -reach + h * (i + 0.5);
    sum += rate({u * std::cos(a) - v * std::sin(a), u * std::sin(a) + v * std::cos(a)}) * h;
  }
  return sum;
}

TEST(TrackProfile, GaussianWithItsCut) {
  const RemovalFunction tif = gaussian_removal(3.0, 2.0, 2.5);
  const auto rate = [](Point p) {
    const double r2 = p.x * p.x + p.y * p.y;
    return r2 <= 2.5 * 2.5 ? 3.0 * std::exp(-4.0 * std::numbers::ln2 * r2 / 4.0) : 0.0;
  };
  const TrackProfile line = line_profile(tif, 33.0), axis = axis_profile(tif, 33.0);
  for (const double v : {-2.4, -1.0, 0.0, 0.3, 2.0}) {
    EXPECT_NEAR(line.value(v), brute_force_line(rate, 33.0, v, 2.5, 20000), 1e-5) << v;
    EXPECT_NEAR(axis.value(v), rate({0.0, v}), 1e-12) << v;
  }
  EXPECT_EQ(line.value(2.51), 0.0);
  EXPECT_EQ(axis.value(-2.51), 0.0);
}

TEST(TrackProfile, DiscIsEquation5OfLin) {
  const double k = 0.7, radius = 3.0;
  const TrackProfile line = line_profile(spinning_disc_removal(k, radius), -117.0);
  const auto rate = [&](Point p) { return length(p) <= radius ? k * length(p) : 0.0; };
  for (const double v : {-2.99, -1.3, -1e-9, 0.0, 0.5, 2.0}) {
    EXPECT_NEAR(line.value(v), brute_force_line(rate, 10.0, v, radius, 200000), 2e-4) << v;
  }
  EXPECT_DOUBLE_EQ(line.value(0.0), k * radius * radius);
  EXPECT_EQ(line.value(3.01), 0.0);
  EXPECT_NEAR(line.value(3.0), 0.0, 1e-7) << "no jump at the rim";
}

/// A spot without any symmetry whose line integrals are known: a tilted elliptic Gaussian off the axis. Along the unit
/// vector e across the line, the integral of peak exp(-(p - c)' M (p - c)) is a Gaussian in v - c.e.
struct Spot {
  double peak = 5.0, a = 1.9, b = 0.6, c = 0.8;  // M = [a b; b c]
  Point centre{0.21, -0.13};

  double rate(Point p) const {
    const Point d = p - centre;
    return peak * std::exp(-(a * d.x * d.x + 2.0 * b * d.x * d.y + c * d.y * d.y));
  }
  double line(double angle_deg, double v) const {
    const double t = angle_deg * kPi / 180.0;
    const Point u{std::cos(t), std::sin(t)}, e{-u.y, u.x};
    const auto form = [this](Point p, Point q) { return a * p.x * q.x + b * (p.x * q.y + p.y * q.x) + c * p.y * q.y; };
    const double w = v - (centre.x * e.x + centre.y * e.y);
    const double uu = form(u, u), ue = form(u, e), ee = form(e, e);
    return peak * std::sqrt(kPi / uu) * std::exp(-(ee - ue * ue / uu) * w * w);
  }
};

RemovalFunction sampled(const Spot& spot) {
  HeightMap rates(Grid{131, 91, 0.11, 0.09, {-4.9, -5.8}});
  rates.quantity = MapQuantity::Rate;
  for (Index i = 0; i < rates.grid.size(); ++i) {
    rates.values[static_cast<std::size_t>(i)] = spot.rate(rates.grid.centre(i));
  }
  return measured_removal(rates, {TifCentre::Kind::Given, {}});
}

TEST(TrackProfile, SampledSpotsAtAnyAngle) {
  const Spot spot;
  const RemovalFunction tif = sampled(spot);
  for (const double angle : {0.0, 90.0, 180.0, -90.0, 30.0, -117.0, 45.0, 1e-7}) {
    const TrackProfile line = line_profile(tif, angle), axis = axis_profile(tif, angle);
    const double t = angle * kPi / 180.0;
    for (const double v : {-2.0, -0.71, 0.0, 0.4, 1.633}) {
      // The spline through samples of 0.11 mm differs from the spot by (h / sigma)^4 / 400 of its peak.
      EXPECT_NEAR(line.value(v), spot.line(angle, v), 2e-4 * spot.line(angle, 0.0)) << angle << " " << v;
      EXPECT_NEAR(axis.value(v), spot.rate({-v * std::sin(t), v * std::cos(t)}), 5e-4 * spot.peak) << angle << " " << v;
    }
    EXPECT_EQ(line.value(line.low - 0.01), 0.0);
    EXPECT_EQ(line.value(line.high + 0.01), 0.0);
  }
}

TEST(TrackProfile, TheAreaUnderALineIsTheVolumeRate) {
  const Spot spot;
  for (const RemovalFunction& tif : {gaussian_removal(3.0, 2.0, 2.5), spinning_disc_removal(0.7, 3.0), sampled(spot)}) {
    for (const double angle : {0.0, 90.0, 20.0}) {
      const TrackProfile line = line_profile(tif, angle);
      double sum = 0.0;
      constexpr int kCells = 40000;
      const double h = (line.high - line.low) / kCells;
      for (int i = 0; i < kCells; ++i) sum += line.value(line.low + h * (i + 0.5)) * h;
      EXPECT_NEAR(sum, tif.volume, 2e-6 * tif.volume) << kind_of(tif) << " " << angle;
    }
  }
}

TEST(TrackProfile, RefusesAnAngleThatIsNone) {
  const RemovalFunction tif = gaussian_removal(3.0, 2.0, 2.5);
  EXPECT_EQ(test::message_of([&] { line_profile(tif, test::kNaN); }), "track: angle = nan degrees; required finite");
  EXPECT_EQ(test::message_of([&] { axis_profile(tif, test::kInf); }), "track: angle = inf degrees; required finite");
}

}  // namespace
}  // namespace dwell
