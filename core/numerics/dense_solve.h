#pragma once

#include <Eigen/Core>

namespace dwell {

// The decompositions of small dense matrices, by Eigen. They are compiled here once, because each adds 5 to 15 s to the
// compilation of a source that uses it. Matrices of a small fixed size are converted to dynamic ones, which costs next
// to nothing.

/// The x that minimises |a x - b|, column by column.
struct LeastSquares {
  Eigen::MatrixXd x;
  Eigen::Index rank = 0;
};

/// Complete orthogonal decomposition. Pivots up to `tolerance` times the largest count as zero (0: rounding alone), and
/// where that leaves x undetermined, the x of smallest norm is returned. Cost O(rows cols^2).
LeastSquares least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance = 0.0);

/// x with a x = b for symmetric positive (semi)definite a, by LDL'. Cost O(rows^3).
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// a = vectors values.asDiagonal() vectors'.
struct SymmetricEigen {
  Eigen::VectorXd values;   // in increasing order
  Eigen::MatrixXd vectors;  // a column each
  bool converged = false;
};

/// Of symmetric a, of which the lower triangle is read. Cost O(rows^3).
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);

/// The singular values in decreasing order, by two-sided Jacobi rotations, which give the small ones as exactly as the
/// large. Cost O(rows^3).
Eigen::VectorXd singular_values(const Eigen::MatrixXd& a);

}  // namespace dwell
