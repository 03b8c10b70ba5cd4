#pragma once

#include <Eigen/Core>

namespace dwell::oracle {

// Dense algebra by Eigen for the slow oracles, by other decompositions than those of core/numerics/dense_solve. One
// library for all test programs, because each decomposition costs a source that names it 5 to 15 s.

/// a = q r, with orthonormal columns in q and r upper triangular, by Householder reflections.
struct ThinQr {
  Eigen::MatrixXd q, r;
};
ThinQr thin_qr(const Eigen::MatrixXd& a);

/// The x that minimises |a x - b|, by Householder reflections with pivoting; the columns of a are independent.
Eigen::MatrixXd least_squares_by_qr(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// In decreasing order, as the positive eigenvalues of (0 r; r' 0) with a = q r: exact to the rounding of the largest.
Eigen::VectorXd singular_values_by_eigenvalues(const Eigen::MatrixXd& a);

/// x with a x = b, by elimination with full pivoting. Empty if a is singular.
Eigen::MatrixXd solve_by_elimination(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace dwell::oracle
