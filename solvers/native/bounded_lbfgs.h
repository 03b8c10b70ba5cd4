#pragma once

#include <functional>
#include <vector>

#include "solvers/native/bounded_quadratic.h"
#include "solvers/problem/quadratic_form.h"

namespace dwell {

/// Projected L-BFGS for a quadratic in a box: minimise q(x) = 1/2 x'Hx + c'x within l <= x <= u. A step is the two-loop
/// recursion (Nocedal 1980, "Updating quasi-Newton matrices with limited storage") restricted to the variables that the
/// bounds leave free (the two-metric projection of Bertsekas 1982), cut off at the bounds; the point then moves along
/// this segment to where q is lowest. Since q is quadratic, that length, the next gradient and the curvature pair all
/// come from one product with H, and the pairs stay exact: they remain valid when the set of active bounds changes,
/// where conjugate gradients have to start anew, and in later calls with another c.
///
/// Monotone and feasible. Pairs are held in single precision: they choose the direction only and do not enter x or its
/// gradient (tests/solvers/native/bounded_lbfgs_test.cpp compares with an exact solver). Same bytes for any number of
/// threads. Memory: 2.5 vectors and the pairs, which take as much as kPairs vectors.
class BoundedLbfgs final : public BoxMinimiser {
 public:
  static constexpr Index kPairs = 5;  // 10, 20 and 40 saved under 10 % of the products and cost more than that

  /// The bounds must outlive this. upper may be empty.
  BoundedLbfgs(const Vector& lower, const Vector& upper, int threads);

  /// Improves the point until |projected gradient| <= tolerance, nothing descends any more (rounding), a product is not
  /// finite, or the monitor, called after every step, says stop. A step costs one product; the first step, and a step
  /// in which the pairs give no descent, may cost two. Successive forms must have about the same H, or forget() must be
  /// called. No allocation.
  void minimise(QuadraticForm& form, double tolerance, QuadraticPoint& point, const Monitor& go_on) override;

  /// Drops the curvature pairs.
  void forget();

 private:
  /// Inner products over the free variables of the pairs and the gradient; columns by age, newest first.
  struct Products {
    Eigen::Matrix<double, kPairs, kPairs> sy, yy;  // s_i'y_k, y_i'y_k
    Eigen::Matrix<double, kPairs, 1> sg, yg;       // s_i'g, y_i'g
    double gg = 0.0;
  };
  /// The quasi-Newton step as a sum: gradient * g + sum_i s_i s[i] + y_i y[i], all over the free variables.
  struct Combination {
    double gradient = 0.0;
    Eigen::Matrix<double, kPairs, 1> s, y;
  };

  Products free_products();
  void sum_block(Index b, Index begin, Index length, const float* gradient);
  Combination two_loops(const Products& products) const;
  double aim(const Combination& step);
  double aim_along_gradient();
  bool find_spectral_length();
  bool advance(double slope);
  double sum_of_blocks() const;
  Index slot(Index age) const { return (newest_ - age + kPairs) % kPairs; }

  const double* upper_at(Index begin) const { return upper_.size() != 0 ? &upper_[begin] : no_upper_.data(); }

  const Vector &lower_, &upper_;
  Vector no_upper_;  // infinity for a block
  int threads_;
  Vector direction_, product_;
  Eigen::VectorXf free_;                                // 1 = free, 0 = held
  Eigen::Matrix<float, Eigen::Dynamic, kPairs> s_, y_;  // steps and their products, scaled to s'y = 1
  static constexpr Index kSums = 1 + 2 * kPairs + kPairs * kPairs + kPairs * (kPairs + 1) / 2;
  Eigen::Matrix<double, kSums, Eigen::Dynamic> sums_;  // by block
  Index pairs_ = 0, newest_ = kPairs - 1;
  double spectral_length_ = 0.0;  // 0 = not known

  // Of the running call.
  QuadraticForm* form_ = nullptr;
  QuadraticPoint* point_ = nullptr;
};

}  // namespace dwell
