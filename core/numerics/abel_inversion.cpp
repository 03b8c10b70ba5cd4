#include "core/numerics/abel_inversion.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/numerics/dense_solve.h"

namespace dwell {
namespace {

/// Integral of 2 r (a + s r) / sqrt(r^2 - v^2) from `from` to `to`, v <= from.
double linear_piece(double a, double s, double v, double from, double to) {
  const auto antiderivative = [&](double r) {
    const double root = std::sqrt(std::max(0.0, r * r - v * v));
    const double logarithm = v > 0.0 ? v * v * std::log(r + root) : 0.0;
    return 2.0 * a * root + s * (r * root + logarithm);
  };
  return to > from ? antiderivative(to) - antiderivative(from) : 0.0;
}

/// Transform at distance v of the hat that is one at k step.
double hat_transform(int k, double step, double v) {
  const double at = step * k;
  double sum = linear_piece(1.0 + k, -1.0 / step, v, std::max(v, at), at + step);
  if (k > 0) sum += linear_piece(1.0 - k, 1.0 / step, v, std::max(v, at - step), at);
  return sum;
}

/// Second differences; about r = 0 the profile is even, beyond the end it is zero.
Eigen::MatrixXd second_differences(int count) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(count, count);
  for (int k = 0; k < count; ++k) {
    d(k, k) = -2.0;
    if (k > 0) d(k, k - 1) += 1.0;
    if (k + 1 < count) d(k, k + 1) += 1.0;
  }
  d(0, 1) = 2.0;
  return d;
}

}  // namespace

double RadialProfile::operator()(double r) const {
  const double place = std::abs(r) / step;
  if (!(place < static_cast<double>(values.size()))) return 0.0;
  const std::size_t k = static_cast<std::size_t>(place);
  const double next = k + 1 < values.size() ? values[k + 1] : 0.0;
  return values[k] + (place - static_cast<double>(k)) * (next - values[k]);
}

RadialProfile abel_inversion(const std::vector<LineIntegral>& integrals, double radius, int count) {
  const double step = radius / count;
  std::vector<LineIntegral> used;
  for (const LineIntegral& line : integrals) {
    if (std::abs(line.offset) < radius) used.push_back(line);
  }
  if (count < 4 || !(radius > 0.0) || used.size() < 4) throw std::invalid_argument("abel_inversion: too few integrals");
  const auto m = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd a(m, count);
  Eigen::VectorXd y(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const LineIntegral& line = used[static_cast<std::size_t>(i)];
    const double root = std::sqrt(line.weight);
    for (int k = 0; k < count; ++k) a(i, k) = root * hat_transform(k, step, std::abs(line.offset));
    y[i] = root * line.value;
  }
  const Eigen::MatrixXd normal = a.transpose() * a, d = second_differences(count), rough = d.transpose() * d;
  Eigen::MatrixXd both(count, count + 1);  // the right-hand side, and the matrix whose trace is that of the influence
  both << a.transpose() * y, normal;
  const double unit = normal.trace() / count;
  RadialProfile best{step, {}, 0.0, 0.0};
  double best_score = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 40; ++k) {
    const double weight = unit * std::pow(10.0, -8.0 + 12.0 * k / 39.0);
    const Eigen::MatrixXd solved = solve_symmetric(normal + weight * rough, both);
    const Eigen::VectorXd b = solved.col(0);
    const double misfit = (a * b - y).squaredNorm() / static_cast<double>(m);
    const double free = 1.0 - solved.rightCols(count).trace() / static_cast<double>(m);
    const double score = misfit / (free * free);
    if (!(free > 1e-6) || !(score < best_score)) continue;
    best_score = score;
    best = {step, std::vector<double>(b.begin(), b.end()), weight / unit, std::sqrt(misfit)};
  }
  if (best.values.empty()) throw std::invalid_argument("abel_inversion: no weight fits");
  return best;
}

}  // namespace dwell
