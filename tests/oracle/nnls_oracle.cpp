#include "tests/oracle/nnls_oracle.h"

#include <stdexcept>
#include <vector>

#include "tests/oracle/dense_algebra.h"

namespace dwell::oracle {
namespace {

using Columns = std::vector<Eigen::Index>;

/// The unconstrained solution on some columns, zero elsewhere.
Eigen::VectorXd solve_on(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Columns& free) {
  Eigen::MatrixXd some(a.rows(), static_cast<Eigen::Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) some.col(static_cast<Eigen::Index>(k)) = a.col(free[k]);
  const Eigen::VectorXd found = least_squares_by_qr(some, b);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  for (std::size_t k = 0; k < free.size(); ++k) x[free[k]] = found[static_cast<Eigen::Index>(k)];
  return x;
}

/// Goes from a feasible x towards y until the first of the free columns is zero, which is no longer free.
void step_to_bound(Eigen::VectorXd& x, const Eigen::VectorXd& y, Columns& free) {
  double share = 1.0;
  for (const Eigen::Index j : free) {
    if (y[j] <= 0.0) share = std::min(share, x[j] / (x[j] - y[j]));
  }
  x += share * (y - x);
  Columns left;
  for (const Eigen::Index j : free) {
    if (x[j] > 1e-14 * x.maxCoeff() && !(y[j] <= 0.0 && share == x[j] / (x[j] - y[j]))) {
      left.push_back(j);
    } else {
      x[j] = 0.0;
    }
  }
  free = left;
}

}  // namespace

Eigen::VectorXd nnls(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const ThinQr qr = thin_qr(a);  // the same problem in as many rows as columns
  const Eigen::MatrixXd& r = qr.r;
  const Eigen::VectorXd target = qr.q.transpose() * b;
  const double tolerance = 1e-10 * (r.transpose() * target).cwiseAbs().maxCoeff();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  Columns free;
  for (Eigen::Index round = 0; round < 10 * a.cols(); ++round) {
    Eigen::VectorXd gain = r.transpose() * (target - r * x);
    for (const Eigen::Index j : free) gain[j] = 0.0;
    Eigen::Index best = 0;
    if (!(gain.maxCoeff(&best) > tolerance)) return x;
    free.push_back(best);
    while (!free.empty()) {
      const Eigen::VectorXd y = solve_on(r, target, free);
      bool inside = true;
      for (const Eigen::Index j : free) inside &= y[j] > 0.0;
      if (inside) {
        x = y;
        break;
      }
      step_to_bound(x, y, free);
    }
  }
  throw std::runtime_error("nnls: no end after ten rounds a column");
}

}  // namespace dwell::oracle
