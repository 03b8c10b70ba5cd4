#pragma once

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

#include "core/base/grid.h"
#include "core/form/form_terms.h"

namespace dwell {

/// The form terms on a set of pixels as orthonormal polynomials q_k(x, y) = c_k . (1, x, y, x^2 + y^2, x^2 - y^2, 2 x
/// y): sum over the pixels of w^2 q_j q_k = delta_jk with w the weights (empty = all one). A few coefficients stand
/// here for what form_basis holds as columns. x and y are centred on the weighted centroid and scaled to at most 1, so
/// that the terms are of one size and a distant origin costs no digits. Terms that are dependent on these pixels (one
/// pixel, one row) are left out. Sums are taken in blocks of pixels, the blocks in order: the same for any number of
/// threads.
class FormPolynomials {
 public:
  static constexpr std::size_t kTerms = 6;
  using Polynomial = std::array<double, kTerms>;  // of 1, x, y, x^2 + y^2, x^2 - y^2, 2 x y

  /// `pixels` (linear indices, ascending for speed) and `weights` are read by the members below: they must live on.
  /// Throws std::invalid_argument for a weight that is not finite. Cost O(pixels).
  FormPolynomials(const Grid& grid, std::span<const Index> pixels, const FormTerms& terms,
                  std::span<const double> weights, int threads);

  Index rank() const { return static_cast<Index>(orthonormal_.size()); }

  /// q_k at a pixel of the list (its linear index), one value for each.
  Eigen::VectorXd at(Index pixel) const;
  /// Columns w q_k: pixels.size() x rank.
  Eigen::MatrixXd columns() const;

  /// The least-squares form of `map_values` (one a pixel of the grid) at the pixels, and its value at any pixel of the
  /// grid. Weights must be empty.
  Polynomial fit(std::span<const double> map_values) const;
  double value_at(const Polynomial& form, Index pixel) const;

  /// Takes the least-squares form out of `map_values` (one a pixel of the grid) at the pixels. Weights must be empty.
  void remove_from(std::span<double> map_values) const;

 private:
  struct Place {
    std::size_t number;  // in the list of pixels
    Index pixel;
    double x, y;
  };
  using Sums = std::array<double, kTerms>;
  /// Sums over the pixels of w^2 times the products of two terms; without astigmatism only of the first four.
  using Gram = std::array<Sums, kTerms>;

  template <class Visit>
  void visit_block(Index block, const Visit& visit) const;
  template <std::size_t N, class Add>
  std::array<double, N> sum(const Add& add) const;
  template <class Visit>
  void for_each(const Visit& visit) const;
  Index blocks() const;
  double weight(std::size_t number) const { return weights_.empty() ? 1.0 : weights_[number]; }
  double size() const;
  void centre_and_scale();
  template <std::size_t Terms>
  Gram gram() const;
  template <std::size_t Terms>
  void add_term(std::size_t term, double size, const Gram& gram);
  template <std::size_t Terms>
  double orthogonalise(Polynomial& candidate) const;
  template <std::size_t Terms>
  void write_columns(Eigen::MatrixXd& q) const;
  template <std::size_t Terms>
  Polynomial fit_terms(std::span<const double> map_values) const;
  template <std::size_t Terms>
  void subtract_form(std::span<double> map_values) const;
  Point scaled(Index pixel) const;

  Grid grid_;
  std::span<const Index> pixels_;
  std::span<const double> weights_;
  int threads_;
  bool astigmatism_;  // without it, only the first four coefficients are ever not zero, and only they are summed
  double centre_x_ = 0.0, centre_y_ = 0.0, per_extent_ = 1.0;
  std::vector<Polynomial> orthonormal_;
};

}  // namespace dwell
