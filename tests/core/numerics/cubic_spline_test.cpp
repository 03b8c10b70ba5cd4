#include "core/numerics/cubic_spline.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace dwell {
namespace {

const std::vector<double> kUneven{-3.0, -2.2, -0.5, 0.1, 1.9, 2.0, 4.5};

/// Oracle: four coefficients an interval, all conditions of the spline as one dense system.
Eigen::VectorXd coefficients_by_dense_algebra(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<Eigen::Index>(x.size()), intervals = n - 1;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4 * intervals, 4 * intervals);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(4 * intervals);
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < intervals; ++i) {
    const double h = x[static_cast<std::size_t>(i) + 1] - x[static_cast<std::size_t>(i)];
    a(row, 4 * i) = 1.0;
    b[row++] = y[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < 4; ++k) a(row, 4 * i + k) = std::pow(h, static_cast<double>(k));
    b[row++] = y[static_cast<std::size_t>(i) + 1];
    if (i + 1 == intervals) break;
    a.row(row).segment(4 * i, 4) << 0.0, 1.0, 2.0 * h, 3.0 * h * h;
    a(row++, 4 * i + 5) = -1.0;
    a.row(row).segment(4 * i, 4) << 0.0, 0.0, 2.0, 6.0 * h;
    a(row++, 4 * i + 6) = -2.0;
  }
  for (const Eigen::Index i : {Eigen::Index{0}, intervals - 2}) {
    a(row, 4 * i + 3) = 1.0;
    a(row++, 4 * i + 7) = -1.0;
  }
  return a.fullPivLu().solve(b);
}

TEST(CubicSpline, IsThatOfItsDefinition) {
  for (const std::size_t places : {std::size_t{4}, std::size_t{5}, kUneven.size()}) {
    const std::vector<double> x(kUneven.begin(), kUneven.begin() + static_cast<std::ptrdiff_t>(places));
    std::vector<double> y;
    for (const double place : x) y.push_back(std::sin(1.7 * place) + 0.3 * place);
    const CubicSpline spline(x, y);
    const std::vector<double> integrals = spline.integrals();
    const Eigen::VectorXd c = coefficients_by_dense_algebra(x, y);
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < places; ++i) {
      const auto at = static_cast<Eigen::Index>(4 * i);
      EXPECT_NEAR(spline.derivatives()[i], c[at + 1], 1e-11) << i;
      const double h = x[i + 1] - x[i];
      for (Eigen::Index k = 0; k < 4; ++k)
        sum += c[at + k] * std::pow(h, static_cast<double>(k + 1)) / static_cast<double>(k + 1);
      EXPECT_NEAR(integrals[i + 1], sum, 1e-11) << i;
      for (const double t : {0.0, 0.3, 0.8}) {
        const double v = c[at] + t * h * (c[at + 1] + t * h * (c[at + 2] + t * h * c[at + 3]));
        EXPECT_NEAR(spline.value(x[i] + t * h), v, 1e-11) << i;
      }
    }
  }
}

TEST(CubicSpline, ReproducesACubicWithItsIntegral) {
  const auto value = [](double x) { return 2.0 - x + 0.5 * x * x - 0.25 * x * x * x; };
  const auto whole = [](double x) { return 2.0 * x - x * x / 2.0 + x * x * x / 6.0 - x * x * x * x / 16.0; };
  std::vector<double> y;
  for (const double x : kUneven) y.push_back(value(x));
  const CubicSpline spline(kUneven, y);
  for (std::size_t i = 0; i < kUneven.size(); ++i) {
    const double x = kUneven[i];
    EXPECT_NEAR(spline.derivatives()[i], -1.0 + x - 0.75 * x * x, 1e-12);
    EXPECT_NEAR(spline.value(x + 0.4), value(x + 0.4), 1e-12);  // at the last place, beyond it
    EXPECT_NEAR(spline.integrals()[i], whole(x) - whole(kUneven[0]), 1e-12);
  }
}

TEST(CubicSpline, NeedsFourPlaces) {
  EXPECT_THROW(CubicSpline({0.0, 1.0, 2.0}, {0.0, 1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(CubicSpline({0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 2.0}), std::invalid_argument);
}

}  // namespace
}  // namespace dwell
