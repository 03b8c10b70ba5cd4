#include "solvers/fits/ceres_nonlinear_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/errors.h"

namespace dwell {
namespace {

/// y = a + b x at uneven places with noise; least squares and its errors have closed forms.
TEST(NonlinearFit, AgreesWithTheClosedFormOfALine) {
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 0.3);
  std::vector<double> x, y;
  for (int i = 0; i < 50; ++i) {
    x.push_back(0.1 * i + 0.003 * i * i);
    y.push_back(2.0 - 0.7 * x.back() + noise(random));
  }
  const NonlinearFit fit = fit_least_squares(
      [&](std::span<const double> v, std::span<double> r) {
        for (std::size_t i = 0; i < x.size(); ++i) r[i] = y[i] - v[0] - v[1] * x[i];
        return true;
      },
      x.size(), {{0.0}, {1.0}});
  double n = 50.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  const double d = n * sxx - sx * sx, slope = (n * sxy - sx * sy) / d, base = (sy - slope * sx) / n;
  double square = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) square += std::pow(y[i] - base - slope * x[i], 2);
  const double variance = square / (n - 2.0);
  EXPECT_NEAR(fit.values[0], base, 1e-6);
  EXPECT_NEAR(fit.values[1], slope, 1e-6);
  EXPECT_NEAR(fit.square_sum, square, 1e-6);
  EXPECT_NEAR(fit.errors[0], std::sqrt(variance * sxx / d), 1e-6);
  EXPECT_NEAR(fit.errors[1], std::sqrt(variance * n / d), 1e-6);
  EXPECT_TRUE(fit.converged);
}

TEST(NonlinearFit, KeepsBoundsAndSaysWhatIsNotDetermined) {
  const NonlinearFit bound = fit_least_squares(
      [](std::span<const double> v, std::span<double> r) {
        for (std::size_t i = 0; i < r.size(); ++i) r[i] = v[0] + 1.0 + 0.1 * static_cast<double>(i % 3);
        return true;
      },
      9, {{3.0, 0.0, 10.0}});
  EXPECT_NEAR(bound.values[0], 0.0, 1e-9);
  const NonlinearFit sum = fit_least_squares(
      [](std::span<const double> v, std::span<double> r) {
        for (std::size_t i = 0; i < r.size(); ++i) r[i] = v[0] + v[1] - static_cast<double>(i);
        return true;
      },
      9, {{1.0}, {1.0}});
  EXPECT_TRUE(std::isnan(sum.errors[0]));
  EXPECT_NEAR(sum.values[0] + sum.values[1], 4.0, 1e-6);
  const NonlinearFit none = fit_least_squares(
      [](std::span<const double>, std::span<double> r) {
        for (double& v : r) v = 2.0;
        return true;
      },
      3, {});
  EXPECT_EQ(none.square_sum, 12.0);
}

TEST(NonlinearFit, IsStoppedWhenAskedTo) {
  Progress progress;
  progress.stop = [] { return true; };
  EXPECT_THROW(fit_least_squares(
                   [](std::span<const double> v, std::span<double> r) {
                     for (double& x : r) x = std::exp(v[0]) - 2.0;
                     return true;
                   },
                   4, {{5.0}}, progress),
               Interrupted);
}

}  // namespace
}  // namespace dwell
