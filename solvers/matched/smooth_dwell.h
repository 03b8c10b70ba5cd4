#pragma once

#include <vector>

#include "solvers/matched/matched_removal.h"
#include "solvers/matched/spline_spreading.h"
#include "solvers/matched/two_scale.h"
#include "solvers/problem/quadratic_form.h"

namespace dwell {

/// Smooth dwell of one part on a coarse lattice: t = P s, the cubic B-spline surface with coefficients s at the dwell
/// points. P has no negative entry and its rows sum to one, so that bounds on s carry over to t.
class SmoothDwell {
 public:
  SmoothDwell(const RemovalGeometry& geometry, CoarseFactor factor);

  /// Grid of the map's pitch that holds every dwell point, on the map's lattice.
  const Grid& cover() const { return cover_; }
  const Grid& lattice() const { return points_.lattice(); }
  Index size() const { return lattice().size(); }
  Index points() const { return points_.strokes(); }
  /// t = P s, for s of this size and t of that of the points.
  void prolong(const Eigen::Ref<const Vector>& s, Eigen::Ref<Vector> t) const { points_.gather(s, t); }
  /// coarse = P'g.
  void restrict_to(const Eigen::Ref<const Vector>& g, Vector& coarse) { points_.spread(g, coarse); }

  /// The coefficients, on this lattice, of the dwell that has `s` on one twice as coarse.
  Vector refined(const SmoothDwell& coarse, const Vector& s) const;
  /// Upper bounds on s that keep P s below `room`, one value a dwell point.
  Vector largest(const Eigen::Ref<const Vector>& room) const;

 private:
  Grid cover_;
  Point origin_;  // of the map
  SplineSpreading points_;
};

/// Smooth dwell of every part of a problem, coefficients and dwell points one part after the other.
class StackedSmoothDwell {
 public:
  /// Every part's geometry must be set.
  StackedSmoothDwell(const DwellProblem& problem, CoarseFactor factor);

  const std::vector<SmoothDwell>& parts() const { return parts_; }
  Index size() const { return size_; }
  /// Whether every part has so many dwell points a coefficient.
  bool has_points_for_each(Index points_per_coefficient) const;
  void prolong(const Vector& s, Vector& t) const;
  void restrict_to(const Vector& g, Vector& coarse);
  Vector refined(const StackedSmoothDwell& coarse, const Vector& s) const;
  /// Upper bounds on s that keep l + P s below the problem's: empty if it has none.
  Vector largest(const DwellProblem& problem) const;

 private:
  std::vector<SmoothDwell> parts_;
  Index size_ = 0;
  Vector part_;
};

/// P'HP for smooth dwell, with every part on the coarse lattice: H of ResolutionMatchedHessian on pixels twice as
/// coarse as the lattice, the sums over dwell points as stencils (points moved to the nearest pixel and strokes shrunk
/// to points: the strokes are far shorter than the lattice's pitch), smoothness along the path as squared slopes. Cost
/// does not depend on the number of points. Of several parts, the removals add up and each has its own stencils.
class SmoothDwellHessian final : public QuadraticForm {
 public:
  /// factor: that of the dwell lattice.
  SmoothDwellHessian(const DwellProblem& problem, const StackedSmoothDwell& dwell, CoarseFactor factor);

  void product(const Vector& d, Vector& hd) override;
  /// The removal's part of the gradient in s for residual r, consistent with product(); see ResolutionMatchedHessian.
  void removal_gradient(const Vector& r, Vector& g);
  double relative_cost() const { return removal_.relative_cost(); }

 private:
  /// The sums of one part.
  struct Sums {
    SplineGram points, penalty;  // P'P; alpha P'D'D P + beta P'P
    TwoScale to_removal;
    Vector density;
  };

  static Sums make_sums(const DwellProblem& problem, const DwellPart& part, const SmoothDwell& dwell,
                        CoarseFactor factor);
  static std::vector<Sums> make_all_sums(const DwellProblem& problem, const StackedSmoothDwell& dwell,
                                         CoarseFactor factor);
  static std::vector<Grid> removal_lattices(const std::vector<Sums>& sums);
  void gather(Vector& result);

  std::vector<Sums> sums_;
  MatchedRemoval removal_;
  std::vector<Vector> coarse_, correlated_;
};

}  // namespace dwell
