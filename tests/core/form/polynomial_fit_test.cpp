#include "core/form/polynomial_fit.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>

#include "core/form/map_statistics.h"
#include "tests/core/base/expect_error.h"
#include "tests/oracle/dense_algebra.h"

namespace dwell {
namespace {

/// A bumpy map without symmetry: unequal pitches, an origin, an annular or ragged part with holes.
HeightMap bumpy(const char* shape) {
  HeightMap map(Grid{47, 61, 0.31, 0.4, {105.0, -33.0}});
  const std::string s = shape;
  for (Index r = 0; r < map.grid.rows; ++r) {
    for (Index c = 0; c < map.grid.cols; ++c) {
      const double u = (static_cast<double>(c) - 30.0) / 29.5, v = (static_cast<double>(r) - 22.5) / 22.4;
      const double rho = std::hypot(u, v);
      if (s == "disc" && rho > 1.0) continue;
      if (s == "annulus" && (rho > 1.0 || rho < 0.4)) continue;
      if (s == "ragged" && (u + 0.7 * v > 1.1 || v < -0.9 + 0.3 * u)) continue;
      if ((7 * r + 3 * c) % 29 == 4) continue;
      map.at(r, c) = 40.0 + 25.0 * u - 13.0 * v + 9.0 * std::sin(5.0 * u + 2.0 * v * v) +
                     static_cast<double>((r * r + 5 * c) % 11) / 3.0;
    }
  }
  return map;
}

struct Dense {
  Eigen::VectorXd coefficients, contributions, residual;
  double condition;
};

/// Oracle: the matrix pixels x polynomials, by Householder QR.
Dense dense_fit(const HeightMap& map, const PolynomialSpec& spec) {
  const std::vector<Index> pixels = finite_pixels(map);
  const auto polynomials = polynomial_basis(map, spec).polynomials;
  Eigen::MatrixXd b(static_cast<Index>(pixels.size()), static_cast<Index>(polynomials.size()));
  Eigen::VectorXd z(b.rows());
  for (Index i = 0; i < b.rows(); ++i) {
    const Index pixel = pixels[static_cast<std::size_t>(i)];
    z[i] = map.values[static_cast<std::size_t>(pixel)];
    for (Index k = 0; k < b.cols(); ++k) {
      b(i, k) = polynomials[static_cast<std::size_t>(k)].value(map.grid.centre(pixel));
    }
  }
  const auto [q, r] = oracle::thin_qr(b);
  Dense dense;
  dense.coefficients = oracle::solve_by_elimination(r, q.transpose() * z);
  dense.contributions =
      r.diagonal().cwiseSign().cwiseProduct(r * dense.coefficients) / std::sqrt(static_cast<double>(b.rows()));
  dense.residual = z - b * dense.coefficients;
  const Eigen::MatrixXd scaled = b * b.colwise().norm().cwiseInverse().asDiagonal();
  const Eigen::VectorXd s = oracle::singular_values_by_eigenvalues(scaled);
  dense.condition = s[0] / s[s.size() - 1];
  return dense;
}

class PolynomialFits : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(PolynomialFits, AreThoseOfDenseQr) {
  const auto [text, shape] = GetParam();
  const HeightMap map = bumpy(shape);
  const PolynomialSpec spec = parse_polynomial_spec(text);
  const Dense dense = dense_fit(map, spec);
  HeightMap residual = map;
  const PolynomialFit fit = remove_polynomials(residual, spec, 2);
  ASSERT_EQ(static_cast<Index>(fit.terms.size()), dense.coefficients.size());
  EXPECT_LE(std::abs(fit.condition / dense.condition - 1.0), 1e-6);
  // Rounding grows with the condition, here up to 3e3; on a disc also with that of the products of Chebyshev
  // polynomials, which reach into the corners (1e-8 of the smallest contributions at degree 12).
  const double tolerance = 1e-12 * dense.condition * dense.coefficients.norm();
  double square = 0.0;
  for (std::size_t k = 0; k < fit.terms.size(); ++k) {
    EXPECT_FALSE(fit.terms[k].dropped) << fit.terms[k].name;
    EXPECT_NEAR(fit.terms[k].coefficient, dense.coefficients[static_cast<Index>(k)], tolerance) << fit.terms[k].name;
    EXPECT_NEAR(fit.terms[k].contribution, dense.contributions[static_cast<Index>(k)], tolerance) << fit.terms[k].name;
    square += fit.terms[k].contribution * fit.terms[k].contribution;
  }
  const std::vector<Index> pixels = finite_pixels(map);
  ASSERT_EQ(finite_pixels(residual), pixels);
  double worst = 0.0, form = 0.0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto pixel = static_cast<std::size_t>(pixels[i]);
    worst = std::max(worst, std::abs(residual.values[pixel] - dense.residual[static_cast<Index>(i)]));
    form += std::pow(map.values[pixel] - residual.values[pixel], 2);
  }
  EXPECT_LE(worst, 1e-10);
  EXPECT_NEAR(square, form / static_cast<double>(pixels.size()), 1e-9 * square);
}

INSTANTIATE_TEST_SUITE_P(
    Bases, PolynomialFits,
    testing::Combine(testing::Values("piston,tilt,power,astigmatism", "zernike-noll:1-36", "zernike-fringe:1-37",
                                     "zernike-ansi:3-20,x=106,y=-25,radius=30", "zernike-noll:1-28,obscuration=0.4",
                                     "legendre:6", "legendre:5x2", "chebyshev:3x7", "zernike-noll:11-11"),
                     testing::Values("full", "disc", "annulus", "ragged")));

TEST(PolynomialFit, OfHighDegreeOnADiscStillLeavesNothingOfThem) {
  HeightMap map = bumpy("disc");
  const PolynomialSpec spec = parse_polynomial_spec("zernike-noll:1-120");
  const Dense dense = dense_fit(map, spec);
  remove_polynomials(map, spec);
  const std::vector<Index> pixels = finite_pixels(map);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    ASSERT_NEAR(map.values[static_cast<std::size_t>(pixels[i])], dense.residual[static_cast<Index>(i)], 1e-9);
  }
}

TEST(PolynomialFit, FindsWhatAMapIsMadeOf) {
  HeightMap map = bumpy("disc");
  const PolynomialSpec spec = parse_polynomial_spec("zernike-fringe:1-16,x=114.5,y=-24,radius=11");
  for (Index i = 0; i < map.grid.size(); ++i) {
    double& z = map.values[static_cast<std::size_t>(i)];
    const double x = (map.grid.centre(i).x - 114.5) / 11.0, y = (map.grid.centre(i).y + 24.0) / 11.0;
    if (std::isfinite(z)) z = 7.0 - 3.0 * y + 20.0 * (2 * (x * x + y * y) - 1) + 5.0 * (2.0 * x * y);
  }
  const PolynomialFit fit = remove_polynomials(map, spec);
  for (std::size_t k = 0; k < fit.terms.size(); ++k) {
    const double expected = k == 0 ? 7.0 : k == 2 ? -3.0 : k == 3 ? 20.0 : k == 5 ? 5.0 : 0.0;
    EXPECT_NEAR(fit.terms[k].coefficient, expected, 1e-10) << fit.terms[k].name;
  }
  EXPECT_EQ(fit.domain.radius, 11.0);
  EXPECT_LE(map_statistics(map, {}).rms, 1e-11);
}

TEST(PolynomialFit, CoefficientsOfUnitRmsOnAFineDiscAreContributions) {
  const Index n = 400;
  HeightMap map(Grid{n, n, 0.1, 0.1, {}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const double x = (static_cast<double>(i % n) - 199.5) / 200.0, y = (static_cast<double>(i / n) - 199.5) / 200.0;
    if (x * x + y * y <= 1.0) map.values[static_cast<std::size_t>(i)] = std::exp(x - 0.5 * y);
  }
  const PolynomialFit fit = remove_polynomials(map, parse_polynomial_spec("zernike-noll:1-22"));
  EXPECT_LE(fit.condition, 1.02);
  for (const PolynomialTerm& term : fit.terms) EXPECT_NEAR(term.coefficient, term.contribution, 0.01) << term.name;
}

TEST(PolynomialFit, OfFormTermsIsThatOfTheProblemItself) {
  const HeightMap map = bumpy("ragged");
  for (const char* text : {"power", "piston,tilt", "piston,tilt,power", "tilt,astigmatism"}) {
    const HeightMap expected = without_form(map, parse_form_terms(text));
    HeightMap residual = map;
    remove_polynomials(residual, parse_polynomial_spec(text));
    for (const Index i : finite_pixels(map)) {
      ASSERT_NEAR(residual.values[static_cast<std::size_t>(i)], expected.values[static_cast<std::size_t>(i)], 1e-11)
          << text;
    }
  }
}

TEST(PolynomialFit, DropsTermsThatDependOnThoseBeforeThem) {
  HeightMap map(Grid{1, 9, 0.5, 0.25, {3.0, 4.0}});
  for (Index c = 0; c < 9; ++c) map.at(0, c) = static_cast<double>(c * c);
  const PolynomialFit fit = remove_polynomials(map, parse_polynomial_spec("zernike-noll:1-6"));
  std::vector<std::string> dropped;
  for (const PolynomialTerm& term : fit.terms) {
    if (term.dropped) dropped.push_back(term.name);
  }
  EXPECT_EQ(dropped, (std::vector<std::string>{"Z3 tilt y", "Z5 astigmatism 45", "Z6 astigmatism 0"}));
  EXPECT_LE(map_statistics(map, {}).rms, 1e-12);

  HeightMap pixel(Grid{3, 4, 0.5, 0.25, {3.0, 4.0}});
  pixel.at(1, 2) = 6.0;
  const PolynomialFit one = remove_polynomials(pixel, parse_polynomial_spec("legendre:2"));
  EXPECT_EQ(one.pixels, 1);
  EXPECT_NEAR(one.terms[0].coefficient, 6.0, 1e-14);
  for (std::size_t k = 1; k < one.terms.size(); ++k) EXPECT_TRUE(one.terms[k].dropped);
  EXPECT_NEAR(pixel.at(1, 2), 0.0, 1e-14);
}

TEST(PolynomialFit, IsTheSameForAnyNumberOfThreads) {
  HeightMap one = bumpy("annulus"), three = one;
  const PolynomialSpec spec = parse_polynomial_spec("zernike-fringe:1-36,obscuration=0.4");
  const PolynomialFit a = remove_polynomials(one, spec, 1), b = remove_polynomials(three, spec, 3);
  for (const Index i : finite_pixels(one)) {
    ASSERT_EQ(one.values[static_cast<std::size_t>(i)], three.values[static_cast<std::size_t>(i)]);
  }
  for (std::size_t k = 0; k < a.terms.size(); ++k) EXPECT_EQ(a.terms[k].coefficient, b.terms[k].coefficient);
}

TEST(PolynomialFit, NeedsAPixelAndRemovesNothingForNone) {
  HeightMap empty(Grid{2, 3, 1.0, 1.0, {}});
  test::expect_input_error([&] { remove_polynomials(empty, parse_polynomial_spec("legendre:2")); }, {"no finite"});
  HeightMap map = bumpy("full");
  const HeightMap before = map;
  EXPECT_TRUE(remove_polynomials(map, parse_polynomial_spec("none")).terms.empty());
  for (const Index i : finite_pixels(map)) {
    EXPECT_EQ(map.values[static_cast<std::size_t>(i)], before.values[static_cast<std::size_t>(i)]);
  }
}

TEST(PolynomialSpecText, ReadsAndWritesEveryKind) {
  for (const char* text : {"none", "piston,tilt", "astigmatism", "zernike-noll:1-36", "zernike-fringe:1-37",
                           "zernike-ansi:0-35,x=1.5,y=-2,radius=20,obscuration=0.3", "legendre:4", "chebyshev:4x3"}) {
    EXPECT_EQ(to_string(parse_polynomial_spec(text)), text);
  }
  const PolynomialSpec spec = parse_polynomial_spec("zernike-ansi:0-35,x=1.5,y=-2,radius=20,obscuration=0.3");
  EXPECT_EQ(spec.centre->y, -2.0);
  EXPECT_EQ(*spec.radius, 20.0);
  EXPECT_EQ(spec.obscuration, 0.3);
}

TEST(PolynomialSpecText, RefusesTheRestNamingIt) {
  for (const char* text : {"zernike:1-36",
                           "zernike-noll:0-4",
                           "zernike-noll:5-4",
                           "zernike-noll:4",
                           "zernike-noll:",
                           "zernike-noll:1-121",
                           "zernike-fringe:1-38",
                           "zernike-ansi:-1-3",
                           "zernike-noll:1-4,x=1",
                           "zernike-noll:1-4,radius=0",
                           "zernike-noll:1-4,radius=inf",
                           "zernike-noll:1-4,x=inf,y=0",
                           "zernike-noll:1-4,obscuration=1",
                           "legendre:",
                           "legendre:15",
                           "legendre:4x",
                           "legendre:4y3",
                           "chebyshev:-1",
                           "coma",
                           "",
                           "zernike-noll:99999999999-3"}) {
    test::expect_input_error([&] { parse_polynomial_spec(text); }, {text, "accepted", "legendre:4x3"});
  }
  test::expect_input_error([] { parse_polynomial_spec("zernike-noll:1-4,diameter=3"); }, {"diameter", "obscuration"});
}

}  // namespace
}  // namespace dwell
