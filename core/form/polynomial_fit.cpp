#include "core/form/polynomial_fit.h"

#include <Eigen/Core>

#include <cmath>

#include "core/numerics/chebyshev_sums.h"
#include "core/numerics/dense_solve.h"

namespace dwell {
namespace {

constexpr double kDependent = 1e-6;  // share of a term's RMS that the others leave
constexpr double kNoise = 1e-14;     // of the largest eigenvalue of a Gram matrix: rounding

/// The polynomials orthonormalised in their order: columns kept, and R with (values of kept terms) = Q R.
struct Factor {
  std::vector<Index> kept;
  Eigen::MatrixXd r;      // kept x kept, upper triangular
  Eigen::MatrixXd terms;  // Chebyshev coefficients, a column each kept term
  double condition = 1.0;
};

double condition_of(const Eigen::MatrixXd& r) {
  if (r.cols() == 0) return 1.0;
  Eigen::MatrixXd scaled = r;
  for (Index k = 0; k < r.cols(); ++k) scaled.col(k) /= r.col(k).norm();
  const Eigen::VectorXd singular = singular_values(scaled);
  return singular[0] / singular[singular.size() - 1];
}

/// With gram = V L V', the columns of L^(1/2) V' terms have the inner products of the terms over the pixels.
Factor orthonormalise(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& terms) {
  const SymmetricEigen eigen = symmetric_eigen(gram);
  const double noise = kNoise * eigen.values.maxCoeff();
  const Eigen::VectorXd root = (eigen.values.array() > noise).select(eigen.values, 0.0).cwiseSqrt();
  const Eigen::MatrixXd columns = root.asDiagonal() * (eigen.vectors.transpose() * terms);
  Eigen::MatrixXd q(columns.rows(), columns.cols()), r = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  Factor factor;
  for (Index k = 0; k < columns.cols(); ++k) {
    const auto rank = static_cast<Index>(factor.kept.size());
    Eigen::VectorXd left = columns.col(k), along = Eigen::VectorXd::Zero(rank);
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Giraud et al. 2005)
      const Eigen::VectorXd c = q.leftCols(rank).transpose() * left;
      left -= q.leftCols(rank) * c;
      along += c;
    }
    const double size = left.norm();
    if (!(size > kDependent * columns.col(k).norm())) continue;
    r.col(rank).head(rank) = along;
    r(rank, rank) = size;
    q.col(rank) = left / size;
    factor.kept.push_back(k);
  }
  const auto rank = static_cast<Index>(factor.kept.size());
  factor.r = r.topLeftCorner(rank, rank);
  factor.terms.resize(terms.rows(), rank);
  for (Index k = 0; k < rank; ++k) factor.terms.col(k) = terms.col(factor.kept[static_cast<std::size_t>(k)]);
  factor.condition = condition_of(factor.r);
  return factor;
}

Eigen::VectorXd solve(const Factor& factor, const Eigen::VectorXd& projection) {
  const auto r = factor.r.triangularView<Eigen::Upper>();
  Eigen::VectorXd c = factor.terms.transpose() * projection;
  r.transpose().solveInPlace(c);
  r.solveInPlace(c);
  return c;
}

ChebyshevSums sums_for(const HeightMap& map, const PolynomialBasis& basis, int threads) {
  const Grid& g = map.grid;
  const PolynomialDomain& d = basis.domain;
  const auto col0 = static_cast<Index>(std::lround((d.x0 - g.origin.x) / g.pitch_x + 0.5));
  const auto row0 = static_cast<Index>(std::lround((d.y0 - g.origin.y) / g.pitch_y + 0.5));
  const auto cols = static_cast<Index>(std::lround((d.x1 - d.x0) / g.pitch_x));
  const auto rows = static_cast<Index>(std::lround((d.y1 - d.y0) / g.pitch_y));
  return {g, row0, col0, rows, cols, basis.degree_x, basis.degree_y, basis.degree_total, threads};
}

}  // namespace

PolynomialFit remove_polynomials(HeightMap& map, const PolynomialSpec& spec, int threads) {
  const PolynomialBasis basis = polynomial_basis(map, spec);
  PolynomialFit fit{basis.domain, basis.normalisation, {}, 1.0, map.valid_pixels()};
  for (const NamedPolynomial& p : basis.polynomials) fit.terms.push_back({p.name, 0.0, 0.0, true});
  if (fit.terms.empty()) return fit;

  const ChebyshevSums sums = sums_for(map, basis, threads);
  Eigen::MatrixXd terms(static_cast<Index>(sums.products().size()), static_cast<Index>(fit.terms.size()));
  const Grid& g = map.grid;
  for (Index k = 0; k < terms.cols(); ++k) {
    const auto& value = basis.polynomials[static_cast<std::size_t>(k)].value;
    terms.col(k) = sums.expand([&](double col, double row) {
      return value({g.origin.x + g.pitch_x * col, g.origin.y + g.pitch_y * row});
    });
  }
  const ChebyshevSums::Sums first = sums.sum(map.values, true);
  const Factor factor = orthonormalise(first.gram, terms);
  fit.condition = factor.condition;
  Eigen::VectorXd projection = first.projection;
  Eigen::VectorXd total = Eigen::VectorXd::Zero(factor.r.cols());
  const int steps = factor.condition < 1e4 ? 2 : 4;
  for (int step = 0; step < steps; ++step) {
    const Eigen::VectorXd c = solve(factor, projection);
    projection = sums.subtract(factor.terms * c, map.values);
    total += c;
  }
  const Eigen::VectorXd orthonormal = factor.r * total / std::sqrt(static_cast<double>(fit.pixels));
  for (std::size_t k = 0; k < factor.kept.size(); ++k) {
    PolynomialTerm& term = fit.terms[static_cast<std::size_t>(factor.kept[k])];
    term.dropped = false;
    term.coefficient = total[static_cast<Index>(k)];
    term.contribution = orthonormal[static_cast<Index>(k)];
  }
  return fit;
}

}  // namespace dwell
