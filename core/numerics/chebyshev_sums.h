#pragma once

#include <Eigen/Core>

#include <span>
#include <utility>
#include <vector>

#include "core/base/grid.h"

namespace dwell {

/// Polynomials on the pixels of a rectangle of a grid in products of Chebyshev polynomials, T_i(x) T_j(y) with the
/// outer edges of the rectangle at -1 and 1. Since T_i T_k = (T_(i+k) + T_|i-k|) / 2, the inner product of any two of
/// them over the valid pixels follows from the sums of T_a T_b alone, 2 degree + 1 multiplications a pixel however many
/// polynomials there are. Only one row of the map is held at a time; rows are summed in order, so that the result is
/// the same for any number of threads.
class ChebyshevSums {
 public:
  /// Pixels `rows` x `cols` from (row0, col0); degrees along each axis and together. Throws std::invalid_argument
  /// unless the rectangle lies in the grid and degrees are >= 0.
  ChebyshevSums(const Grid& grid, Index row0, Index col0, Index rows, Index cols, int degree_x, int degree_y,
                int degree_total, int threads);

  /// Exponents (i, j) of the products, i <= degree_x, j <= degree_y, i + j <= degree_total.
  const std::vector<std::pair<int, int>>& products() const { return products_; }

  /// Sums over the finite pixels of `values` (one a pixel of the grid).
  struct Sums {
    Index pixels = 0;
    Eigen::MatrixXd gram;        // of the products with each other; empty if not wanted
    Eigen::VectorXd projection;  // of the values with each product
  };
  Sums sum(std::span<const double> values, bool with_gram) const;

  /// values -= sum_k coefficients_k product_k in the rectangle (NaN stays), and the projections of what is left.
  Eigen::VectorXd subtract(const Eigen::VectorXd& coefficients, std::span<double> values) const;

  /// The Chebyshev coefficients of a polynomial of no higher degree, given as a function of column and row (real
  /// numbers, in pixels of the grid). Exact to rounding: interpolation at the Chebyshev nodes.
  template <class Value>
  Eigen::VectorXd expand(const Value& value) const;

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  void project_row(const double* filled, double* out) const;
  Eigen::VectorXd fold_projections(const std::vector<double>& of_rows) const;
  Eigen::MatrixXd gram_of(const std::vector<double>& moment_of_rows) const;
  double node(int k, int degree) const;
  Eigen::VectorXd expand_samples(const Eigen::MatrixXd& samples) const;

  Grid grid_;
  Index row0_, col0_, rows_, cols_;
  int degree_x_, degree_y_, threads_;
  std::vector<std::pair<int, int>> products_;
  RowMajor along_x_;  // (2 degree_x + 1) x cols: T_a at every column
  RowMajor along_y_;  // rows x (2 degree_y + 1)
};

template <class Value>
Eigen::VectorXd ChebyshevSums::expand(const Value& value) const {
  Eigen::MatrixXd samples(degree_x_ + 1, degree_y_ + 1);
  for (int i = 0; i <= degree_x_; ++i) {
    for (int j = 0; j <= degree_y_; ++j) {
      const double x = static_cast<double>(col0_) - 0.5 + 0.5 * (node(i, degree_x_) + 1.0) * static_cast<double>(cols_);
      const double y = static_cast<double>(row0_) - 0.5 + 0.5 * (node(j, degree_y_) + 1.0) * static_cast<double>(rows_);
      samples(i, j) = value(x, y);
    }
  }
  return expand_samples(samples);
}

}  // namespace dwell
