#include "core/tif/removal_analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/numbers.h"
#include "core/tif/models/removal_models.h"
#include "tests/core/base/expect_error.h"

namespace dwell {
namespace {

constexpr double kLn2 = std::numbers::ln2;

RemovalAnalysis of(const std::string& text) {
  return analyse_removal(removal_samples(removal_of_spec(parse_spec_text(text, "tif"))));
}

// The transform of exp(-4 ln 2 r^2 / w^2) is exp(-pi^2 w^2 f^2 / (4 ln 2)).
TEST(AnalyseRemoval, KnowsTheWavesOfAGaussian) {
  const RemovalAnalysis a = of("gaussian:peak=7,fwhm=2.5,radius=6");
  const auto wave = [](double share) { return 2.5 * kPi / std::sqrt(4.0 * kLn2 * std::log(1.0 / share)); };
  for (const auto& [found, share] : {std::pair{a.at_tenth, 0.1}, {a.at_half, 0.5}}) {
    EXPECT_NEAR(found.x.value(), wave(share), 2e-3 * wave(share));
    EXPECT_NEAR(found.y.value(), wave(share), 2e-3 * wave(share));
    EXPECT_NEAR(found.radial.value(), wave(share), 2e-3 * wave(share));
  }
  EXPECT_NEAR(a.fwhm_x, 2.5, 1e-3);
  EXPECT_NEAR(a.fwhm_y, 2.5, 1e-3);
  EXPECT_NEAR(a.sigma_major, 2.5 / std::sqrt(8.0 * kLn2), 1e-3);
  EXPECT_LE(a.asymmetry, 1e-3);
  // 99 % of a Gaussian's volume lies within sigma sqrt(2 ln 100).
  EXPECT_NEAR(a.radius, a.sigma_major * std::sqrt(2.0 * std::log(100.0)), 0.05);
  EXPECT_NEAR(a.transfer.along_x.front(), 1.0, 1e-12);
}

/// Transform of the spinning disc's rate r inside R over its volume: with z = 2 pi f R it is
/// (3 / z^3) integral from 0 to z of t^2 J0(t) dt = (3 / z^3) (z^2 J1(z) + z J0(z) - integral of J0).
double disc_response(double f, double radius) {
  const double z = 2.0 * kPi * f * radius;
  double integral = 0.0;
  constexpr int kSteps = 2000;
  for (int k = 0; k < kSteps; ++k) integral += std::cyl_bessel_j(0.0, z * (k + 0.5) / kSteps) * z / kSteps;
  return std::abs(3.0 / (z * z * z) * (z * z * std::cyl_bessel_j(1.0, z) + z * std::cyl_bessel_j(0.0, z) - integral));
}

TEST(AnalyseRemoval, KnowsTheTransferFunctionOfADisc) {
  const RemovalAnalysis a = of("disc:slope=2,radius=3");
  for (std::size_t k = 8; k < a.transfer.frequency.size(); k += 7) {
    const double f = a.transfer.frequency[k];
    if (f > 2.0) break;  // six waves in the radius: beyond, the samples' own cell counts
    EXPECT_NEAR(a.transfer.along_x[k], disc_response(f, 3.0), 2e-3) << f;
    EXPECT_NEAR(a.transfer.radial[k], disc_response(f, 3.0), 2e-3) << f;
  }
  EXPECT_NEAR(a.volume, 2.0 * kPi / 3.0 * 2.0 * 27.0, 1e-3 * a.volume);
}

TEST(AnalyseRemoval, TellsDirectionsApart) {
  const RemovalAnalysis a = of("elliptic-gaussian:fwhm_x=4,fwhm_y=1.5,angle=30,peak=3");
  EXPECT_NEAR(a.angle, 30.0, 0.2);
  EXPECT_NEAR(a.sigma_major / a.sigma_minor, 4.0 / 1.5, 0.02);
  EXPECT_GT(a.asymmetry, 0.3);
  // Along x the wave sees the ellipse's projection on x: width sqrt((4 cos)^2 + (1.5 sin)^2).
  const double across = std::hypot(4.0 * std::cos(kPi / 6), 1.5 * std::sin(kPi / 6));
  EXPECT_NEAR(a.at_tenth.x.value(), across * kPi / std::sqrt(4.0 * kLn2 * std::log(10.0)), 0.02);
  EXPECT_GT(a.at_tenth.x.value(), a.at_tenth.y.value() * 1.3);
}

TEST(AnalyseRemoval, SeesTheOuterFlanksOfARing) {
  const RemovalAnalysis a = of("planetary:radius=1,eccentricity=1.5,peak=3");
  EXPECT_GT(a.fwhm_x, 3.0);
  EXPECT_LT(a.fwhm_x, 5.0);
  EXPECT_NEAR(a.centroid.x, 0.0, 1e-9);
}

TEST(AnalyseRemoval, RefusesNoData) {
  test::expect_input_error([] { analyse_removal(HeightMap(Grid{5, 6, 0.1, 0.1, {}})); }, {"largest rate is 0"});
}

TEST(ShortestWave, IsWhereTheResponseFirstFalls) {
  EXPECT_NEAR(shortest_wave({0.0, 1.0, 2.0, 3.0}, {1.0, 0.6, 0.2, 0.9}, 0.4).value(), 1.0 / 1.5, 1e-12);
  EXPECT_FALSE(shortest_wave({0.0, 1.0}, {1.0, 0.6}, 0.4).has_value());
}

// Of closed forms no figure is that of their samples.
TEST(AnalyseRemoval, TakesTheFiguresOfAFormulaExactly) {
  const RemovalFunction disc = spinning_disc_removal(1.0, 1.5);
  const RemovalAnalysis a = with_exact_figures(analyse_shape(removal_samples(disc)), disc);
  EXPECT_DOUBLE_EQ(a.peak, 1.5);
  EXPECT_DOUBLE_EQ(a.fwhm, std::sqrt(3.0) * 1.5);
  EXPECT_EQ(a.fwhm_x, 3.0);
  EXPECT_EQ(a.fwhm_y, 3.0);
  EXPECT_EQ(a.asymmetry, 0.0);
  EXPECT_DOUBLE_EQ(a.volume, disc.volume);
  const RemovalFunction cut = gaussian_removal(5.0, 4.0, 1.25);  // its radius is within the half peak
  EXPECT_EQ(with_exact_figures(analyse_shape(removal_samples(cut)), cut).fwhm_x, 2.5);
  const RemovalFunction sampled = removal_of_spec(parse_spec_text("super-gaussian:peak=3,fwhm=4,order=4", "tif"));
  const RemovalAnalysis shape = analyse_shape(removal_samples(sampled));
  EXPECT_EQ(with_exact_figures(shape, sampled).fwhm, shape.fwhm);
}

}  // namespace
}  // namespace dwell
