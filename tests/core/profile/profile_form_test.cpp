#include "core/profile/profile_form.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

using test::expect_input_error;
using Function = std::function<double(double)>;

/// Uneven places from -31 to 84 mm.
std::vector<double> uneven_places() {
  std::vector<double> x{-31.0};
  for (int i = 0; i < 90; ++i) x.push_back(x.back() + 0.5 + 1.5 * static_cast<double>((i * i) % 7) / 6.0);
  return x;
}

LineProfile profile_of(ProfileQuantity quantity, const Function& value) {
  const std::vector<double> x = uneven_places();
  std::vector<double> values;
  for (const double place : x) values.push_back(value(place));
  return line_profile(quantity, x, values);
}

double ripple(double x) { return 0.3 * std::sin(0.9 * x) + 0.1 * std::cos(2.3 * x + 1.0); }

/// Oracle: weighted least squares by normal equations in shifted millimetres.
std::vector<double> rest_by_normal_equations(const LineProfile& profile, int powers) {
  const auto n = static_cast<Eigen::Index>(profile.x.size());
  const std::vector<double> lengths = place_lengths(profile.x);
  Eigen::MatrixXd a(n, powers);
  Eigen::VectorXd b(n), w(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (int power = 0; power < powers; ++power) a(i, power) = std::pow((profile.x[k] - 20.0) / 50.0, power);
    b[i] = profile.values()[k];
    w[i] = lengths[k];
  }
  const Eigen::VectorXd c = (a.transpose() * w.asDiagonal() * a).llt().solve(a.transpose() * w.asDiagonal() * b);
  const Eigen::VectorXd rest = b - a * c;
  return {rest.data(), rest.data() + n};
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(ProfileForm, PolynomialsAreThoseOfWeightedLeastSquares) {
  const auto value = [](double x) { return 5.0 + 0.2 * x - 0.01 * x * x + 1e-4 * x * x * x + ripple(x); };
  const LineProfile slope = profile_of(ProfileQuantity::Slope, value),
                    height = profile_of(ProfileQuantity::Height, value);
  // A polynomial of the height has a slope of one degree less.
  const std::vector<std::pair<const char*, int>> forms{{"none", 0},         {"piston", 1},       {"piston,tilt", 2},
                                                       {"polynomial:1", 2}, {"polynomial:2", 3}, {"polynomial:5", 6}};
  for (const auto& [text, powers] : forms) {
    const ProfileForm form = parse_profile_form(text);
    expect_near(remove_profile_form(height, form).profile.height, rest_by_normal_equations(height, powers), 1e-9);
    const std::vector<double> left = powers > 1 ? rest_by_normal_equations(slope, powers - 1) : slope.slope;
    expect_near(remove_profile_form(slope, form).profile.slope, left, 1e-9);
  }
  EXPECT_NEAR(*remove_profile_form(profile_of(ProfileQuantity::Height, [](double x) { return 3.0 + 0.7 * x; }),
                                   parse_profile_form("piston,tilt"))
                   .tilt,
              0.7, 1e-12);
}

TEST(ProfileForm, ASphereIsACircleOfEitherSign) {
  for (const double radius : {900.0, -2500.0}) {  // mm; so small that a parabola is far off
    const auto middle = 0.5 * (uneven_places().front() + uneven_places().back());
    const auto height = [&](double x) {
      const double u = x - middle;
      return 1e6 * (radius - std::copysign(std::sqrt(radius * radius - u * u), radius)) + 12.0 + 40.0 * x;
    };
    const auto slope = [&](double x) {
      const double u = x - middle;
      return 1e6 * u / std::copysign(std::sqrt(radius * radius - u * u), radius) + 40.0;
    };
    for (const char* text : {"sphere", radius > 0 ? "sphere:radius=900" : "sphere:radius=-2500"}) {
      const ProfileRest by_height =
          remove_profile_form(profile_of(ProfileQuantity::Height, height), parse_profile_form(text));
      const ProfileRest by_slope =
          remove_profile_form(profile_of(ProfileQuantity::Slope, slope), parse_profile_form(text));
      EXPECT_LT(profile_figures(by_height.profile).height_pv, 1e-5);
      EXPECT_LT(profile_figures(by_slope.profile).slope_pv, 1e-6);
      for (const ProfileRest& rest : {by_height, by_slope}) {
        EXPECT_NEAR(*rest.radius, radius, 1e-6 * std::abs(radius));
        EXPECT_NEAR(*rest.tilt, 40.0, 1e-5);
      }
    }
  }
}

const EllipseMirror kMirror{3000.0, 700.0, 0.02};

/// An ellipse whose pole is at x = 14 mm, source at the low end, on a mirror that lies tilted, with ripple.
Function ellipse_slope(double side) {
  return [side](double x) { return 1e6 * side * ellipse_at(kMirror, side * (x - 14.0)).slope - 120.0 + ripple(x); };
}
Function ellipse_height(double side) {
  return
      [side](double x) { return 1e6 * ellipse_at(kMirror, side * (x - 14.0)).height - 120.0 * x + 55.0 + ripple(x); };
}

const std::string kEllipse = "ellipse:p=3000,q=700,angle=1.145915590261646";

TEST(ProfileForm, AnEllipseAtItsPoleLeavesTheRippleWithoutTilt) {
  const std::vector<double> ripples =
      remove_profile_form(profile_of(ProfileQuantity::Height, ripple), parse_profile_form("piston,tilt"))
          .profile.height;
  for (const double side : {1.0, -1.0}) {
    const ProfileForm form = parse_profile_form(kEllipse + ",at=14,source=" + (side > 0.0 ? "low" : "high"));
    const ProfileRest rest = remove_profile_form(profile_of(ProfileQuantity::Height, ellipse_height(side)), form);
    expect_near(rest.profile.height, ripples, 1e-6);
    EXPECT_EQ(*rest.pole, 14.0);
    EXPECT_TRUE(rest.hints.empty());
    // The slope of a height is that of its cubic spline, which knows no ripple between places.
    const ProfileRest of_slope = remove_profile_form(profile_of(ProfileQuantity::Slope, ellipse_slope(side)), form);
    expect_near(of_slope.profile.slope,
                remove_profile_form(profile_of(ProfileQuantity::Slope, ripple), parse_profile_form("piston,tilt"))
                    .profile.slope,
                1e-7);
  }
}

TEST(ProfileForm, PoleAndAngleAreFound) {
  const auto plain = [](double x) { return ellipse_slope(1.0)(x) - ripple(x); };
  const LineProfile profile = profile_of(ProfileQuantity::Slope, plain);
  const ProfileRest position = remove_profile_form(profile, parse_profile_form(kEllipse));
  EXPECT_NEAR(*position.pole, 14.0, 1e-6);
  EXPECT_NEAR(*position.tilt, -120.0, 1e-4);
  EXPECT_LT(profile_figures(position.profile).slope_pv, 1e-6);
  const ProfileRest angle =
      remove_profile_form(profile, parse_profile_form("ellipse:p=3000,q=700,angle=1.2,at=14,fit=angle"));
  EXPECT_NEAR(*angle.angle, 0.02, 1e-9);
  const ProfileRest both =
      remove_profile_form(profile, parse_profile_form("ellipse:p=3000,q=700,angle=1.16,fit=position+angle"));
  EXPECT_NEAR(*both.pole, 14.0, 1e-3);
  EXPECT_NEAR(*both.angle, 0.02, 1e-6);
  const ProfileRest none = remove_profile_form(profile, parse_profile_form(kEllipse + ",fit=none"));
  EXPECT_NEAR(*none.pole, 0.5 * (profile.x.front() + profile.x.back()), 1e-12);
  EXPECT_GT(profile_figures(none.profile).slope_rms, 0.05);
}

TEST(ProfileForm, AFitIsALeastSquare) {
  const LineProfile profile = profile_of(ProfileQuantity::Slope, ellipse_slope(1.0));
  const ProfileRest rest = remove_profile_form(profile, parse_profile_form(kEllipse));
  const std::vector<double> lengths = place_lengths(profile.x);
  const double best = rms_about_mean(rest.profile.slope, lengths);
  for (const double aside : {-0.2, 0.2}) {
    const ProfileRest other =
        remove_profile_form(profile, parse_profile_form(kEllipse + ",at=" + std::to_string(*rest.pole + aside)));
    EXPECT_GT(rms_about_mean(other.profile.slope, lengths), best);
  }
}

TEST(ProfileForm, AnotherSignOrEndIsSaid) {
  const LineProfile high = profile_of(ProfileQuantity::Slope, ellipse_slope(-1.0));
  const ProfileRest rest = remove_profile_form(high, parse_profile_form(kEllipse + ",at=14"));
  ASSERT_EQ(rest.hints.size(), 1u);
  EXPECT_NE(rest.hints[0].find("source=high would leave"), std::string::npos) << rest.hints[0];
  const LineProfile negative = profile_of(ProfileQuantity::Slope, [](double x) { return -ellipse_slope(1.0)(x); });
  expect_input_error([&] { remove_profile_form(negative, parse_profile_form(kEllipse)); },
                     {kEllipse, "the other sign of the values would leave"});
  const ProfileRest fixed = remove_profile_form(negative, parse_profile_form(kEllipse + ",at=14"));
  ASSERT_FALSE(fixed.hints.empty());
  EXPECT_NE(fixed.hints[0].find("other"), std::string::npos);
}

TEST(ProfileForm, RefusesWhatItCannotFit) {
  const LineProfile four = line_profile(ProfileQuantity::Height, {0.0, 1.0, 2.5, 3.0}, {1.0, 2.0, 1.0, 4.0});
  expect_input_error([&] { remove_profile_form(four, parse_profile_form("polynomial:3")); },
                     {"polynomial:3", "4 parameters", "4 places"});
  const LineProfile profile = profile_of(ProfileQuantity::Slope, ripple);
  expect_input_error([&] { remove_profile_form(profile, parse_profile_form("sphere:radius=40")); },
                     {"sphere:radius=40", "does not reach from x = -31"});
  expect_input_error([&] { remove_profile_form(profile, parse_profile_form("ellipse:p=50,q=20,angle=3,at=0")); },
                     {"does not reach"});
  expect_input_error([&] { remove_profile_form(profile, parse_profile_form("ellipse:p=7500,q=2500,angle=0.6")); },
                     {"ellipse:p=7500,q=2500,angle=0.6", "at=MM"});
}

TEST(ProfileForm, RefusesTextsThatAreNone) {
  for (const char* text : {"",
                           "tilt",
                           "piston, tilt",
                           "sphere:",
                           "circle",
                           "polynomial",
                           "polynomial:0",
                           "polynomial:21",
                           "polynomial:2.5",
                           "ellipse",
                           "ellipse:p=1,q=2",
                           "ellipse:p=0,q=2,angle=1",
                           "ellipse:p=1,q=2,angle=91",
                           "ellipse:p=1,q=2,angle=0",
                           "ellipse:p=1,q=2,angle=nan",
                           "ellipse:p=1,q=2,angle=1,at=1e9",
                           "ellipse:p=1,q=2,angle=1,source=left",
                           "ellipse:p=1,q=2,angle=1,fit=p",
                           "ellipse:p=1,q=2,angle=1,theta=3",
                           "sphere:radius=0",
                           "sphere:radius=inf",
                           "sphere:r=5"}) {
    EXPECT_THROW(parse_profile_form(text), InputError) << text;
  }
}

}  // namespace
}  // namespace dwell
