#pragma once

#include <Eigen/Core>

namespace dwell::oracle {

/// The x >= 0 that minimises |a x - b|, by the active sets of Lawson and Hanson (Solving Least Squares Problems, 1974,
/// ch. 23), each least-squares problem by Householder reflections. Throws std::runtime_error if it does not end. For
/// some hundreds of columns.
Eigen::VectorXd nnls(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace dwell::oracle
