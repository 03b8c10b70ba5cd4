#pragma once

#include "solvers/matched/matched_removal.h"
#include "solvers/matched/spline_spreading.h"
#include "solvers/matched/two_scale.h"
#include "solvers/problem/quadratic_form.h"

namespace dwell {

/// Smooth dwell on a coarse lattice: t = P s, the cubic B-spline surface with coefficients s at the dwell points. P has
/// no negative entry and its rows sum to one, so that bounds on s carry over to t.
class SmoothDwell {
 public:
  SmoothDwell(const RemovalGeometry& geometry, CoarseFactor factor);

  /// Grid of the map's pitch that holds every dwell point, on the map's lattice.
  const Grid& cover() const { return cover_; }
  const Grid& lattice() const { return points_.lattice(); }
  Index size() const { return lattice().size(); }
  void prolong(const Vector& s, Vector& t) const { points_.gather(s, t); }          // t = P s
  void restrict_to(const Vector& g, Vector& coarse) { points_.spread(g, coarse); }  // coarse = P'g

  /// The coefficients, on this lattice, of the dwell that has `s` on one twice as coarse.
  Vector refined(const SmoothDwell& coarse, const Vector& s) const;
  /// Upper bounds on s that keep l + P s below the problem's: empty if it has none.
  Vector largest(const DwellProblem& problem) const;

 private:
  Grid cover_;
  Point origin_;  // of the map
  SplineSpreading points_;
};

/// P'HP for smooth dwell, with every part on the coarse lattice: H of ResolutionMatchedHessian on pixels twice as
/// coarse as the lattice, the sums over dwell points as stencils (points moved to the nearest pixel and strokes shrunk
/// to points: the strokes are far shorter than the lattice's pitch), smoothness along the path as squared slopes. Cost
/// does not depend on the number of points.
class SmoothDwellHessian final : public QuadraticForm {
 public:
  /// factor: that of the dwell lattice.
  SmoothDwellHessian(const DwellProblem& problem, const SmoothDwell& dwell, CoarseFactor factor);

  void product(const Vector& d, Vector& hd) override;
  /// The removal's part of the gradient in s for residual r, consistent with product(); see ResolutionMatchedHessian.
  void removal_gradient(const Vector& r, Vector& g);
  double relative_cost() const { return removal_.relative_cost(); }

 private:
  SplineGram points_, penalty_;  // P'P; alpha P'D'D P + beta P'P
  TwoScale to_removal_;
  MatchedRemoval removal_;
  Vector density_, coarse_, correlated_, part_;
};

}  // namespace dwell
