#pragma once

#include <optional>
#include <vector>

#include "core/padded_convolution.h"
#include "core/scattered_removal.h"
#include "solvers/dwell_problem.h"
#include "solvers/matched_kernel.h"
#include "solvers/quadratic_form.h"
#include "solvers/spline_gram.h"

namespace dwell {

/// What the pixels make of a removal known on the coarse lattice: v = S' W (I - Q Q') W S d for d the spline
/// coefficients of a removal A t = S d. Exact for ragged apertures, weights and form terms.
class MatchedPixels {
 public:
  MatchedPixels(const DwellProblem& problem, CoarseFactor factor);

  const Grid& lattice() const { return gram_.lattice(); }
  void apply(const Vector& d, Vector& v) const;

 private:
  SplineGram gram_;
  Eigen::MatrixXd form_;  // S' W Q
};

/// The Hessian of a dwell problem with the removal held on pixels matched to the removal function. A t is smooth on the
/// scale of the removal function, so it is the spline through its values at every q-th pixel: A = S A_c to that
/// accuracy, and
///
///   H = A_c' S' W (I - Q Q') W S A_c + alpha D'D + beta I
///
/// where A_c takes the same strokes to the coarse lattice. The same variables; the transforms are about q^2 cheaper.
/// problem.geometry must be set; the problem must outlive this.
class ResolutionMatchedHessian final : public QuadraticForm {
 public:
  ResolutionMatchedHessian(const DwellProblem& problem, CoarseFactor factor);
  void product(const Vector& d, Vector& hd) override;
  /// The smoothness along the path with a ridge, solved exactly: what is left of H where the removal is blind.
  void precondition(const std::vector<char>& free, const Vector& r, Vector& out) override;
  /// Cost of a product in operator pairs of the full problem, by transform_cost.
  double relative_cost() const { return relative_cost_; }

 private:
  const DwellProblem& problem_;
  MatchedPixels pixels_;
  std::optional<ScatteredRemoval> removal_;
  Vector surface_, weighed_, scratch_;
  double relative_cost_ = 1.0;
};

/// Smooth dwell on a coarse lattice: t = P s, the cubic B-spline surface with coefficients s at the dwell points. P has
/// no negative entry and its rows sum to one, so that bounds on s carry over to t.
class SmoothDwell {
 public:
  SmoothDwell(const RemovalGeometry& geometry, CoarseFactor factor);

  /// Grid of the map's pitch that holds every dwell point, on the map's lattice.
  const Grid& cover() const { return cover_; }
  Index size() const { return nodes_; }
  void prolong(const Vector& s, Vector& t) const;           // t = P s
  void restrict_to(const Vector& g, Vector& coarse) const;  // coarse = P' g

  /// s of the same dwell as `coarse_s` on a lattice twice as coarse whose nodes are all in this one.
  void refine(const SmoothDwell& coarse, const Vector& coarse_s, Vector& s) const;
  /// Upper bounds on s that keep l + P s below the problem's: empty if it has none.
  Vector largest(const DwellProblem& problem) const;

 private:
  struct Place {
    Index first;
    std::array<double, 4> x, y;
  };
  Place place(Point p) const;

  const std::vector<Stroke>* strokes_;
  Grid cover_, lattice_;
  Index first_row_ = 0, first_col_ = 0;  // of the lattice, in its pitches from the map's origin
  Index nodes_ = 0;
};

/// P'HP for smooth dwell, with every part on the coarse lattice: H of ResolutionMatchedHessian, the sums over dwell
/// points as stencils (points moved to the nearest pixel and strokes shrunk to points: the strokes are far shorter than
/// the lattice's pitch), smoothness along the path as squared slopes. Cost does not depend on the number of points.
class SmoothDwellHessian final : public QuadraticForm {
 public:
  SmoothDwellHessian(const DwellProblem& problem, const SmoothDwell& dwell, CoarseFactor factor);
  void product(const Vector& d, Vector& hd) override;
  double relative_cost() const { return relative_cost_; }

 private:
  MatchedPixels pixels_;
  SplineGram points_, penalty_;  // P'P; alpha P'D'D P + beta P'P
  std::optional<PaddedConvolution> convolution_;
  std::vector<Index> field_node_;  // of every node of the dwell lattice, -1 = out of reach
  Vector density_, surface_, weighed_, correlated_, part_;
  double relative_cost_ = 1.0;
};

}  // namespace dwell
