#include "core/form/zernike.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "core/numerics/dense_solve.h"

namespace dwell {
namespace {

ZernikeIndex noll_index(int number) {
  int n = 0;
  while ((n + 1) * (n + 2) / 2 < number) ++n;
  const int place = number - n * (n + 1) / 2 - 1;
  const int m = n % 2 == 0 ? (place + 1) / 2 * 2 : place / 2 * 2 + 1;
  return {n, number % 2 == 0 ? m : -m};
}

ZernikeIndex fringe_index(int number) {
  if (number == last_zernike(ZernikeOrdering::Fringe)) return {12, 0};
  int group = 0;  // (n + |m|) / 2
  while ((group + 1) * (group + 1) < number) ++group;
  const int place = number - group * group - 1;
  const int m = group - place / 2;
  return {2 * group - m, place % 2 == 0 ? m : -m};
}

ZernikeIndex ansi_index(int number) {
  int n = 0;
  while ((n + 1) * (n + 2) / 2 <= number) ++n;
  return {n, 2 * number - n * (n + 2)};
}

/// Nodes and weights of the Gauss-Legendre rule on [lower, upper] (Golub and Welsch 1969).
std::pair<Eigen::ArrayXd, Eigen::ArrayXd> gauss_legendre(int count, double lower, double upper) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(count, count);
  for (int k = 1; k < count; ++k) {
    jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1.0);
  }
  const SymmetricEigen eigen = symmetric_eigen(jacobi);
  const double half = 0.5 * (upper - lower);
  const Eigen::ArrayXd first = eigen.vectors.row(0).transpose().array();
  return {lower + half * (1.0 + eigen.values.array()), 2.0 * half * first.square()};
}

}  // namespace

std::string to_string(ZernikeOrdering ordering) {
  if (ordering == ZernikeOrdering::Noll) return "noll";
  return ordering == ZernikeOrdering::Fringe ? "fringe" : "ansi";
}

int first_zernike(ZernikeOrdering ordering) { return ordering == ZernikeOrdering::Ansi ? 0 : 1; }

int last_zernike(ZernikeOrdering ordering) {
  if (ordering == ZernikeOrdering::Noll) return 120;  // all of degree 14
  return ordering == ZernikeOrdering::Fringe ? 37 : 119;
}

ZernikeIndex zernike_index(ZernikeOrdering ordering, int number) {
  if (number < first_zernike(ordering) || number > last_zernike(ordering)) {
    throw std::invalid_argument(fmt::format("Zernike number {} in the ordering {}", number, to_string(ordering)));
  }
  if (ordering == ZernikeOrdering::Noll) return noll_index(number);
  return ordering == ZernikeOrdering::Fringe ? fringe_index(number) : ansi_index(number);
}

std::string zernike_name(ZernikeIndex index) {
  static const std::array<const char*, 6> kAround{"", "coma", "astigmatism", "trefoil", "tetrafoil", "pentafoil"};
  const int m = std::abs(index.m);
  if (index.n == 0) return "piston";
  if (index.n == 1) return index.m > 0 ? "tilt x" : "tilt y";
  if (index.n == 2 && m == 0) return "defocus";
  if (index.n > 5) return fmt::format("({}, {})", index.n, index.m);
  if (m == 0) return "spherical";
  const std::string rank = index.n - m >= (m == 1 ? 4 : 2) ? "secondary " : "";
  const std::string name = rank + kAround[static_cast<std::size_t>(m)];
  if (m == 1) return name + (index.m > 0 ? " x" : " y");
  return fmt::format("{} {:.3g}", name, index.m > 0 ? 0.0 : 90.0 / m);
}

Zernike::Zernike(ZernikeIndex index, double obscuration, Normalisation normalisation) : index_(index), scale_(1.0) {
  const int m = std::abs(index.m), count = (index.n - m) / 2;
  if (index.n < m || (index.n - m) % 2 != 0 || !(obscuration >= 0.0 && obscuration < 1.0)) {
    throw std::invalid_argument(fmt::format("Zernike ({}, {}), obscuration {}", index.n, index.m, obscuration));
  }
  // The integrands are of degree 2 count + m = n + count at most: the rule is exact.
  const auto [t, weights] = gauss_legendre(index.n + 1, obscuration * obscuration, 1.0);
  const Eigen::ArrayXd measure = weights * t.pow(m);
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(t.size()), now = Eigen::ArrayXd::Ones(t.size());
  double square = measure.sum(), square_before = 0.0;
  for (int k = 0; k < count; ++k) {
    alpha_.push_back((measure * t * now.square()).sum() / square);
    beta_.push_back(k == 0 ? 0.0 : square / square_before);
    const Eigen::ArrayXd next = (t - alpha_.back()) * now - beta_.back() * before;
    before = now;
    now = next;
    square_before = square;
    square = (measure * now.square()).sum();
  }
  const double area = 1.0 - obscuration * obscuration;
  scale_ =
      normalisation == Normalisation::UnitEdge ? 1.0 / radial(1.0) : std::sqrt((m == 0 ? 1.0 : 2.0) * area / square);
}

double Zernike::radial(double t) const {
  double before = 0.0, now = 1.0;
  for (std::size_t k = 0; k < alpha_.size(); ++k) {
    before = std::exchange(now, (t - alpha_[k]) * now - beta_[k] * before);
  }
  return now;
}

double Zernike::operator()(double x, double y) const {
  const std::complex<double> z(x, y);
  std::complex<double> power = 1.0;  // rho^m (cos m theta + i sin m theta)
  for (int k = 0; k < std::abs(index_.m); ++k) power *= z;
  return scale_ * radial(x * x + y * y) * (index_.m < 0 ? power.imag() : power.real());
}

}  // namespace dwell
