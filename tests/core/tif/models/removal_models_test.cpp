#include "core/tif/models/removal_models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/tif/models/bonnet_shape.h"
#include "core/tif/models/gaussian_shapes.h"
#include "core/tif/models/planetary_shape.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;

constexpr double kPi = std::numbers::pi;

/// What a point at `p` sees of a pad in planetary motion, by running the motion in small steps of time: position of the
/// pad's centre and of the pad's own point over `p` in the frame of the pad, whose difference quotient is the speed.
double simulated_planetary(double radius, double eccentricity, double ratio, Point p) {
  constexpr int kSteps = 200'000;
  constexpr double kStep = 1e-6;
  const double arm = eccentricity * radius;
  // Where the material point of the pad that is over p at angle t is at angle t + dt of the arm.
  const auto moved = [&](double t, double dt) {
    const Point c{arm * std::cos(t), arm * std::sin(t)}, d = p - c;
    const double spin = (1.0 + ratio) * dt;  // the arm turns the pad along, the spindle adds ratio
    const Point next{arm * std::cos(t + dt), arm * std::sin(t + dt)};
    return next + Point{std::cos(spin) * d.x - std::sin(spin) * d.y, std::sin(spin) * d.x + std::cos(spin) * d.y};
  };
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double t = 2.0 * kPi * (k + 0.5) / kSteps;
    if (std::hypot(p.x - arm * std::cos(t), p.y - arm * std::sin(t)) > radius) continue;
    sum += distance(moved(t, 0.5 * kStep), moved(t, -0.5 * kStep)) / kStep;
  }
  return sum / kSteps;
}

TEST(PlanetaryShape, IsTheMotionRunInSmallSteps) {
  for (const auto& [radius, eccentricity, ratio] :
       {std::array{2.0, 0.8, -1.0}, {3.0, 0.5, 4.0}, {1.0, 1.6, -3.0}, {2.5, 1.0, 0.3}}) {
    const RemovalShape shape = planetary_shape(radius, eccentricity, ratio);
    const double outer = radius * (1.0 + eccentricity);
    EXPECT_NEAR(shape.reach, outer, 1e-12);
    for (const double share : {eccentricity == 1.0 ? 0.01 : 0.0, 0.07, 0.3, 0.55, 0.8, 0.97, 1.01}) {
      const Point p{0.6 * share * outer, -0.8 * share * outer};
      EXPECT_NEAR(shape.value(p), simulated_planetary(radius, eccentricity, ratio, p), 1e-4 * shape.peak)
          << radius << " " << eccentricity << " " << ratio << " at " << share;
    }
  }
}

TEST(PlanetaryShape, WithoutEccentricityIsTheSpinningDisc) {
  const RemovalShape shape = planetary_shape(3.0, 0.0, 1.5);
  for (const double r : {0.0, 0.4, 1.7, 2.99}) EXPECT_NEAR(shape.value({0.0, r}), 2.5 * r, 3e-6 * shape.peak);
  EXPECT_EQ(shape.value({0.0, 3.01}), 0.0);
  expect_input_error([] { planetary_shape(3.0, 0.0, -1.0); }, {"ratio = -1", "eccentricity = 0", "does not move"});
}

// Zha et al. 2020, table 1: the deviation of summed tracks over one period is smallest at 40 % overlap. The width over
// which the paper takes it is not said; over one period, with the peak at one, an independent sum of 4000 points gave
// the figures below (numpy, arccos((rho^2 + d^2 - r^2) / (2 rho d)) / pi).
TEST(PlanetaryShape, FillsBestAtFortyPercentOverlap) {
  const RemovalShape shape = planetary_shape(1.0, 0.8, -1.0);
  const std::array expected{0.23330, 0.20519, 0.17180, 0.12356, 0.12684, 0.23031};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double spacing = (0.9 - 0.1 * static_cast<double>(k)) * 3.6;
    constexpr int kPoints = 4000;
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < kPoints; ++i) {
      const double y = spacing * (i + 0.5) / kPoints;
      double rate = 0.0;
      for (int track = -6; track <= 7; ++track) rate += shape.value({0.0, y - track * spacing}) / shape.peak;
      sum += rate;
      square += rate * rate;
    }
    const double deviation = std::sqrt(square / kPoints - std::pow(sum / kPoints, 2));
    EXPECT_NEAR(deviation, expected[k], 1e-4) << k;
  }
}

/// The sliding speed over w by the cross product of the spin with the lever arm, and Hertz's pressure.
double bonnet_by_vectors(const BonnetContact& c, Point p) {
  const double r2 = p.x * p.x + p.y * p.y, lean = c.precession * kPi / 180.0;
  if (r2 >= c.radius * c.radius) return 0.0;
  const int count = c.positions > 0 ? c.positions : 7200;
  double sum = 0.0;
  for (int k = 0; k < count; ++k) {
    const double towards = c.angle * kPi / 180.0 + 2.0 * kPi * k / count;
    const std::array w{std::sin(lean) * std::cos(towards), std::sin(lean) * std::sin(towards), std::cos(lean)};
    const std::array arm{p.x, p.y, -std::sqrt(c.cap * c.cap - c.radius * c.radius)};
    const double vx = w[1] * arm[2] - w[2] * arm[1], vy = w[2] * arm[0] - w[0] * arm[2];
    sum += std::sqrt(vx * vx + vy * vy);
  }
  return std::pow(1.0 - r2 / (c.radius * c.radius), c.exponent) * sum / count;
}

TEST(BonnetShape, IsPressureTimesTheSpeedOfATiltedSpin) {
  for (const BonnetContact& c : {BonnetContact{4.0, 20.0, 15.0, 1, 0.5, 30.0},
                                 {4.0, 20.0, 15.0, 2, 0.5, -70.0},
                                 {4.0, 20.0, 10.0, 4, 1.5, 20.0},
                                 {4.0, 9.0, 23.0, 0, 0.5, 0.0}}) {
    const RemovalShape shape = bonnet_shape(c);
    double largest = 0.0;
    for (int row = -45; row <= 45; ++row) {
      for (int col = -45; col <= 45; ++col) {
        const Point p{0.1 * col, 0.1 * row};
        if (c.positions > 0 || row % 15 == 0) {
          EXPECT_NEAR(shape.value(p), bonnet_by_vectors(c, p), 1e-5 * shape.peak) << p.x << " " << p.y;
        }
        largest = std::max(largest, shape.value(p));
      }
    }
    EXPECT_GE(shape.peak, largest);
    EXPECT_LE(shape.peak, 1.002 * largest);
  }
}

TEST(BonnetShape, StandsStillWhereTheSpinAxisMeetsThePart) {
  const BonnetContact c{4.0, 20.0, 8.0, 1, 0.5, 0.0};
  const double h = std::sqrt(400.0 - 16.0), x = -h * std::tan(8.0 * kPi / 180.0);
  EXPECT_NEAR(bonnet_shape(c).value({x, 0.0}), 0.0, 1e-12);
  EXPECT_GT(bonnet_shape(c).value({-x, 0.0}), 1.0);
  expect_input_error([] { bonnet_shape({4.0, 3.0, 8.0, 1, 0.5, 0.0}); }, {"cap = 3", "radius"});
}

TEST(GaussianShapes, FallToHalfWhereTheySay) {
  // The long axis, 4 mm wide, turned by 30 degrees.
  const RemovalShape ellipse = elliptic_gaussian_shape(4.0, 1.0, 30.0);
  EXPECT_NEAR(ellipse.value({2.0 * std::cos(kPi / 6), 2.0 * std::sin(kPi / 6)}), 0.5, 1e-12);
  EXPECT_NEAR(ellipse.value({-0.5 * std::sin(kPi / 6), 0.5 * std::cos(kPi / 6)}), 0.5, 1e-12);
  const RemovalShape flat = super_gaussian_shape(3.0, 6.0);
  EXPECT_NEAR(flat.value({0.0, -1.5}), 0.5, 1e-12);
  EXPECT_GT(flat.value({0.75, 0.0}), 0.98);
  // Ribbon to +y: half the peak 2 mm upstream (-y) and 0.5 mm downstream.
  const RemovalShape d = mrf_shape(2.0, 0.5, 3.0, 90.0);
  EXPECT_NEAR(d.value({0.0, -2.0}), 0.5, 1e-12);
  EXPECT_NEAR(d.value({0.0, 0.5}), 0.5, 1e-12);
  EXPECT_NEAR(d.value({1.5, 0.0}), 0.5, 1e-12);
}

RemovalFunction of(const std::string& text) { return removal_of_spec(parse_spec_text(text, "tif")); }

TEST(RemovalOfSpec, GivesThePeakAndTheClosedVolume) {
  const RemovalFunction mrf = of("mrf:lead=2,trail=0.6,width=3,angle=25,peak=40");
  EXPECT_EQ(kind_of(mrf), "mrf");
  EXPECT_NEAR(mrf.peak, 40.0, 1e-12);  // the axis is a sample
  // Two half Gaussians along, one across: sqrt(pi / ln 2) (lead + trail) / 2 times sqrt(pi / ln 2) width / 2.
  EXPECT_NEAR(mrf.volume, 40.0 * kPi / std::numbers::ln2 * 1.3 * 1.5, 1e-3 * mrf.volume);  // cut off at its reach
  EXPECT_EQ(mrf.samples.quantity, MapQuantity::Rate);
  ASSERT_EQ(mrf.samples.history.size(), 1u);
  EXPECT_NE(mrf.samples.history[0].find("mrf"), std::string::npos);
  const RemovalFunction ellipse = of("elliptic-gaussian:fwhm_x=4,fwhm_y=1,angle=30,peak=3");
  EXPECT_NEAR(ellipse.volume, 3.0 * kPi / (4.0 * std::numbers::ln2) * 4.0, 3e-3 * ellipse.volume);
}

// The volume rate by Preston's law: K p times the mean speed over the pad times the area of the pad.
TEST(RemovalOfSpec, PrestonsLawGivesTheRate) {
  const RemovalFunction tif = of("planetary:radius=5,eccentricity=0.8,ratio=-1,preston=2e-13,pressure=20000,rpm=120");
  const double speed = 2.0 * kPi * 2.0 * 4.0;         // mm/s: 120 rpm at 4 mm
  const double rate = 2e-13 * 20000.0 * speed * 1e6;  // nm/s under the pad
  EXPECT_NEAR(tif.volume, rate * kPi * 25.0, 1e-3 * tif.volume);
  EXPECT_NEAR(tif.peak, rate, 1e-3 * rate);  // points near the axis are always under the pad
}

TEST(RemovalOfSpec, RefusesWhatIsOutOfRange) {
  expect_input_error([] { of("planetary:radius=0,eccentricity=0.8,peak=1"); },
                     {"planetary", "radius = 0 mm", "> 1e-06"});
  expect_input_error([] { of("planetary:radius=1,peak=1"); }, {"eccentricity", "missing"});
  expect_input_error([] { of("planetary:radius=1,eccentricity=0.8"); }, {"rpm", "missing"});
  expect_input_error([] { of("planetary:radius=1,eccentricity=0.8,peak=1,rpm=3"); }, {"either peak"});
  expect_input_error([] { of("mrf:lead=1,trail=1,width=1,peak=1,rpm=3"); }, {"rpm", "lead, trail, width, angle"});
  expect_input_error([] { of("mrf:lead=1,trail=1,width=1,peak=-1"); }, {"peak = \"-1\"", "from 1e-09 to 1e+09 (nm/s)"});
  expect_input_error([] { of("mrf:lead=1,trail=inf,width=1,peak=1"); }, {"trail = inf"});
  expect_input_error([] { of("bonnet:radius=1,cap=20,precession=15,positions=2.5,peak=1"); },
                     {"positions = 2.5", "whole"});
  expect_input_error([] { of("planatary:radius=1"); }, {"'planatary'", "planetary", "bonnet"});
}

TEST(RemovalModels, RowsAreWhole) {
  RemovalMoments moments;
  moments.peak = 5.0;
  moments.fwhm = moments.major = 4.0;
  moments.minor = 3.0;
  moments.edge = 3.5;
  for (const RemovalModel& model : removal_models()) {
    EXPECT_FALSE(model.name.empty() || model.about.empty() || model.parameters.empty()) << model.name;
    EXPECT_EQ(&removal_model(model.name), &model);
    const std::vector<ModelStart> starts = model.starts(moments);
    ASSERT_FALSE(starts.empty()) << model.name;
    for (const ModelStart& start : starts) {
      ASSERT_EQ(start.values.size(), model.parameters.size()) << model.name;
      for (std::size_t k = 0; k < start.values.size(); ++k) {
        EXPECT_NO_THROW(check_model_parameter(model, model.parameters[k], start.values[k])) << model.name;
      }
    }
  }
}

TEST(RemovalModels, AnMrfSpotHasItsLongSideUpstream) {
  const RemovalModel& mrf = removal_model("mrf");
  std::vector<double> values{1.0, 3.0, 2.0, 10.0};
  mrf.make_canonical(values, {false, true, false, false});
  EXPECT_EQ(values, (std::vector<double>{1.0, 3.0, 2.0, 10.0})) << "held";
  mrf.make_canonical(values, {false, false, false, false});
  EXPECT_EQ(values, (std::vector<double>{3.0, 1.0, 2.0, 190.0}));
}

TEST(RemovalModels, ALeanAllRoundHasNoDirection) {
  const RemovalModel& bonnet = removal_model("bonnet");
  const double kNone = std::nan("");
  EXPECT_TRUE(bonnet.idle(5, std::vector<double>{kNone, 20.0, kNone, 0.0, kNone, kNone}));
  EXPECT_FALSE(bonnet.idle(5, std::vector<double>{kNone, 20.0, kNone, 4.0, kNone, kNone}));
  EXPECT_FALSE(bonnet.idle(2, std::vector<double>{kNone, 20.0, kNone, 0.0, kNone, kNone}));
}

}  // namespace
}  // namespace dwell
