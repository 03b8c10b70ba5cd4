#include "tests/oracle/dense_algebra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace dwell::oracle {

ThinQr thin_qr(const Eigen::MatrixXd& a) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
  ThinQr thin;
  thin.q = qr.householderQ() * Eigen::MatrixXd::Identity(a.rows(), a.cols());
  thin.r = qr.matrixQR().topRows(a.cols()).triangularView<Eigen::Upper>();
  return thin;
}

Eigen::MatrixXd least_squares_by_qr(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Eigen::VectorXd singular_values_by_eigenvalues(const Eigen::MatrixXd& a) {
  const Eigen::MatrixXd r = thin_qr(a).r;
  const Eigen::Index n = r.rows();
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  both.topRightCorner(n, n) = r;
  both.bottomLeftCorner(n, n) = r.transpose();
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(both).eigenvalues();
  return values.tail(n).reverse();
}

Eigen::MatrixXd solve_by_elimination(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(a);
  if (!lu.isInvertible()) return {};
  return lu.solve(b);
}

}  // namespace dwell::oracle
