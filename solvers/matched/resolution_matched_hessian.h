#pragma once

#include "solvers/matched/matched_removal.h"
#include "solvers/matched/spline_spreading.h"
#include "solvers/problem/quadratic_form.h"

namespace dwell {

/// The Hessian of a dwell problem with the removal held on pixels matched to the removal function (MatchedRemoval):
///
///   H = P'K' S'W (I - Q Q') W S K P + alpha D'D + beta I
///
/// where P spreads the strokes on the coarse dwell lattice. The same variables as the problem's; the transforms are
/// about q^2 cheaper, what remains is some 60 multiply-adds a dwell point. Every part's geometry must be set; the
/// problem must outlive this.
class ResolutionMatchedHessian final : public QuadraticForm {
 public:
  ResolutionMatchedHessian(const DwellProblem& problem, CoarseFactor factor);

  void product(const Vector& d, Vector& hd) override;
  /// The gradient at t with residual r, its removal taken as this Hessian takes it: |r - change of removal|^2 / 2 is
  /// then bounded below as the true objective is. With the exact gradient, the little of it that the model holds to be
  /// beyond its reach promises everything: on ibfest-70x30 an objective below zero.
  void gradient(const Vector& r, const Vector& t, Vector& g);
  /// Cost of a product in operator pairs of the full problem, by transform_cost.
  double relative_cost() const { return removal_.relative_cost(); }

 private:
  void gather(Vector& result);

  const DwellProblem& problem_;
  std::vector<SplineSpreading> strokes_;  // of each part
  MatchedRemoval removal_;
  std::vector<Vector> density_, correlated_;
};

}  // namespace dwell
