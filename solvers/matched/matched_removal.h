#pragma once

#include <optional>
#include <vector>

#include "core/numerics/padded_convolution.h"
#include "solvers/matched/matched_kernel.h"
#include "solvers/matched/spline_gram.h"
#include "solvers/problem/dwell_problem.h"

namespace dwell {

/// The removal of a dwell problem on pixels matched to the removal function. A t is smooth on the scale of the removal
/// function, so it is the spline S d through its values at every q-th pixel, and d = K c: the coarse kernel times the
/// dwell c that stands on the nodes of a coarse dwell lattice. What the pixels make of it is exact for ragged
/// apertures, weights and form terms: S'W (I - Q Q') W S. Work on the map's own pixels is done once, when made, and
/// once per adjoint(). problem.geometry must be set; the problem must outlive this.
class MatchedRemoval {
 public:
  /// dwell: nodes on the map's lines at every factor-th pixel, anywhere.
  MatchedRemoval(const DwellProblem& problem, const Grid& dwell, CoarseFactor factor);

  /// out = K'S'W (I - Q Q') W S K c.
  void normal(const Vector& c, Vector& out);
  /// out = K'S'W r for a residual r of the problem: this model's own gradient, consistent with normal().
  void adjoint(const Vector& r, Vector& out);
  /// Cost of normal() in operator pairs of the full problem, by transform_cost.
  double relative_cost() const { return relative_cost_; }

 private:
  void correlate(const Vector& surface, Vector& out);

  const DwellProblem& problem_;
  SplineGram pixels_;
  Eigen::MatrixXd form_;  // S'W Q
  std::optional<PaddedConvolution> convolution_;
  std::vector<Index> field_node_;  // of every node of the dwell lattice, -1 = out of reach
  Vector surface_, weighed_, weighted_;
  double relative_cost_ = 1.0;
};

}  // namespace dwell
