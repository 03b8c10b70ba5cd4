#include "core/form/form.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/core/base/expect_error.h"
#include "tests/oracle/dense_algebra.h"

namespace dwell {
namespace {

/// Oracle: least squares by plain normal equations in millimetres, terms in raw coordinates.
Eigen::VectorXd residual_by_normal_equations(const Grid& grid, const std::vector<Index>& pixels, const FormTerms& terms,
                                             const std::vector<double>& weights, const Eigen::VectorXd& v) {
  std::vector<Eigen::VectorXd> columns;
  const auto m = static_cast<Index>(pixels.size());
  const auto add = [&](auto term) {
    Eigen::VectorXd column(m);
    for (Index i = 0; i < m; ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      column[i] = weights[k] * term(grid.centre(pixels[k]));
    }
    columns.push_back(column);
  };
  if (terms.piston) add([](Point) { return 1.0; });
  if (terms.tilt) add([](Point p) { return p.x; });
  if (terms.tilt) add([](Point p) { return p.y; });
  if (terms.power) add([](Point p) { return p.x * p.x + p.y * p.y; });
  if (terms.astigmatism) add([](Point p) { return p.x * p.x - p.y * p.y; });
  if (terms.astigmatism) add([](Point p) { return p.x * p.y; });
  Eigen::MatrixXd b(m, static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) b.col(static_cast<Index>(k)) = columns[k];
  return v - b * oracle::least_squares_by_qr(b, v);
}

struct Case {
  FormTerms terms;
  bool weighted;
};

class FormBasis : public testing::TestWithParam<Case> {};

TEST_P(FormBasis, IsOrthonormalAndRemovesWhatNormalEquationsRemove) {
  const Grid grid{7, 11, 0.3, 0.2, {1.5, -0.7}};
  std::vector<Index> pixels;
  for (Index i = 0; i < grid.size(); ++i) {
    if (i % 5 != 3) pixels.push_back(i);
  }
  std::vector<double> weights(pixels.size(), 1.0);
  if (GetParam().weighted) {
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 0.2 + static_cast<double>(i % 4);
    weights[10] = 0.0;
  }
  Eigen::VectorXd v(static_cast<Index>(pixels.size()));
  for (Index i = 0; i < v.size(); ++i) v[i] = 3.0 + std::sin(static_cast<double>(7 * i % 13));

  const Eigen::MatrixXd basis =
      form_basis(grid, pixels, GetParam().terms, GetParam().weighted ? weights : std::vector<double>{});
  const Index terms = (GetParam().terms.piston ? 1 : 0) + (GetParam().terms.tilt ? 2 : 0) +
                      (GetParam().terms.power ? 1 : 0) + (GetParam().terms.astigmatism ? 2 : 0);
  ASSERT_EQ(basis.cols(), terms);
  ASSERT_EQ(basis.rows(), v.size());
  const Eigen::MatrixXd gram = basis.transpose() * basis;
  EXPECT_LE((gram - Eigen::MatrixXd::Identity(terms, terms)).norm(), 1e-14);

  const Eigen::VectorXd expected = residual_by_normal_equations(grid, pixels, GetParam().terms, weights, v);
  remove_form(basis, v);
  // The normal equations square the condition of raw coordinates (about 1e3 here): 1e-10 is their accuracy.
  EXPECT_LE((v - expected).norm(), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Terms, FormBasis,
                         testing::Values(Case{{true, false, false}, false}, Case{{true, true, false}, false},
                                         Case{{true, true, true}, false}, Case{{true, true, true}, true},
                                         Case{{true, true, true, true}, false}, Case{{true, true, true, true}, true},
                                         Case{{true, true, false, true}, true}, Case{{true, true, false}, true}));

TEST(FormBasisRank, DropsColumnsThatDependOnTheOthers) {
  const Grid grid{3, 4, 0.1, 0.1, {1e3, -1e3}};
  const FormTerms all{true, true, true};
  EXPECT_EQ(form_basis(grid, {5}, all).cols(), 1);           // one pixel: piston
  EXPECT_EQ(form_basis(grid, {4, 5}, all).cols(), 2);        // two: a line
  EXPECT_EQ(form_basis(grid, {4, 5, 6, 7}, all).cols(), 3);  // one row: piston, x, x^2
  EXPECT_EQ(form_basis(grid, {0, 1, 4, 5}, all).cols(), 3);  // a square: x^2 + y^2 is constant on it
  EXPECT_EQ(form_basis(grid, {0, 1, 4, 5, 6}, all).cols(), 4);
  const FormTerms astigmatic{true, true, true, true};
  EXPECT_EQ(form_basis(grid, {4, 5, 6, 7}, astigmatic).cols(), 3);     // one row: x^2 - y^2 is x^2 as well
  EXPECT_EQ(form_basis(grid, {0, 1, 4, 5, 6}, astigmatic).cols(), 5);  // as many as pixels
  EXPECT_EQ(form_basis(grid, {}, all).cols(), 0);
  EXPECT_EQ(form_basis(grid, {0, 1}, {}).cols(), 0);
  EXPECT_EQ(form_basis(grid, {0, 1}, all, {0.0, 0.0}).cols(), 0);
}

TEST(FormBasisRank, RefusesWeightsThatDoNotMatch) {
  const Grid grid{2, 2, 1.0, 1.0, {}};
  EXPECT_THROW(form_basis(grid, {0, 1}, {true, false, false}, {1.0}), std::invalid_argument);
  EXPECT_THROW(form_basis(grid, {0, 1}, {true, false, false}, {1.0, NAN}), std::invalid_argument);
}

TEST(FormBasisRank, RemovesTermsToRoundingFarFromTheOrigin) {
  const Grid grid{40, 60, 0.1, 0.1, {5e4, -3e4}};
  std::vector<Index> pixels(static_cast<std::size_t>(grid.size()));
  std::iota(pixels.begin(), pixels.end(), Index{0});
  Eigen::VectorXd v(grid.size());
  for (Index i = 0; i < grid.size(); ++i) {
    const double x = 0.1 * static_cast<double>(i % 60), y = 0.1 * static_cast<double>(i / 60);
    v[i] = 1e3 + 20.0 * x - 7.0 * y + 2.0 * (x * x + y * y);
  }
  remove_form(form_basis(grid, pixels, {true, true, true}), v);
  EXPECT_LE(v.norm(), 1e-10);
}

TEST(FormTermsText, ParsesAnyOrderAndPrintsOne) {
  EXPECT_EQ(parse_form_terms("tilt, piston"), (FormTerms{true, true, false}));
  EXPECT_EQ(parse_form_terms("power"), (FormTerms{false, false, true}));
  EXPECT_EQ(parse_form_terms("none"), FormTerms{});
  EXPECT_EQ(to_string(parse_form_terms("power,tilt,piston")), "piston,tilt,power");
  EXPECT_EQ(parse_form_terms("astigmatism,piston"), (FormTerms{true, false, false, true}));
  EXPECT_EQ(to_string(parse_form_terms("astigmatism,power")), "power,astigmatism");
  EXPECT_EQ(to_string(FormTerms{}), "none");
}

TEST(FormTermsText, NamesTheUnknownWord) {
  test::expect_input_error([] { parse_form_terms("piston,coma"); }, {"'coma'", "piston, tilt, power, astigmatism"});
  test::expect_input_error([] { parse_form_terms(""); }, {"''", "none"});
  test::expect_input_error([] { parse_form_terms("piston,"); }, {"''"});
  test::expect_input_error([] { parse_form_terms("none,piston"); }, {"'none'", "none alone"});
}

}  // namespace
}  // namespace dwell
