#pragma once

#include <memory>
#include <vector>

#include "core/removal/removal_geometry.h"
#include "runs/plan/part.h"
#include "runs/plan/uncertainty_spec.h"
#include "solvers/problem/dwell_problem.h"
#include "solvers/problem/expected_removal.h"

namespace dwell {

/// The expected residual of a dwell under an uncertainty, as rows of a dwell problem (docs/uncertainty.md):
///
///   E|P ((A + e_r A + e_w A_w + e_x A_x + e_y A_y) t - z)|^2 = |P (A t - z)|^2 + sum of sigma_k^2 |P A_k t|^2
///
/// A_w is the change by the logarithm of the tool's width, A_x and A_y by a shift. An offset counts as it is; a
/// rotation as shifts of the mean square that it makes over the part: in x by its sigma times the RMS of y about the
/// middle, and the other way round. The errors of the ends of moves are each on their own, and so their squares add up:
/// sigma^2 |grad b|^2 t_j^2 for every stroke, taken with the mean of |grad b|^2, the rate averaged over the two strokes
/// that share an end, over strokes whole on the part: a weight on |t|^2. Noise of the map does not depend on the dwell.
class ExpectedRows {
 public:
  /// `removal`: the operator of `geometry`; both must outlive this, unless they are owned. Throws as kernel_by_width.
  /// Cost: the setup of up to three more operators.
  ExpectedRows(const Part& part, const std::shared_ptr<const RemovalGeometry>& geometry, RemovalOperator& removal,
               const UncertaintySpec& unsure);

  RemovalOperator& removal() { return *rows_; }
  const std::vector<RemovalChange>& changes() const { return changes_; }
  double beta() const { return beta_; }  // weight of |t|^2 [nm^2/s^2]

 private:
  std::vector<RemovalChange> changes_;
  std::vector<std::unique_ptr<RemovalOperator>> operators_;
  std::unique_ptr<ExpectedRemoval> rows_;
  double beta_ = 0.0;
};

}  // namespace dwell
