#pragma once

#include "core/numerics/spline_sampling.h"
#include "core/removal/scattered_removal.h"

namespace dwell {

/// Removal by a tool much wider than a pixel. What it removes is as smooth as it is itself: the cubic spline S d
/// through its values at every kernel.coarse-th pixel, d = B^-1 B^-1 b W t with the strokes spread on that coarse
/// lattice (ScatteredRemoval with the kernel of matched_kernel) and S the spline at the pixels (SplineSampling). The
/// transform, which is nearly all of ScatteredRemoval's cost, is then coarse.x coarse.y times as small. The error is
/// that of splines, of the fourth order in pitch over sigma: for a Gaussian 1e-4 at a pitch of sigma / 4. apply_adjoint
/// is the exact transpose of apply. Cost of a call: 16 or more multiply-adds a stroke, about five a pixel, and the
/// coarse transform pair.
class CoarseRemoval final : public RemovalOperator {
 public:
  /// map, pixels, kernel: as for ScatteredRemoval; kernel.coarse says how coarse.
  CoarseRemoval(const Grid& map, std::vector<Index> pixels, const RemovalKernel& kernel,
                const std::vector<Stroke>& strokes, int threads);

  std::string name() const override { return "coarse"; }

 private:
  void do_apply(const Vector& t, Vector& removal) override;
  void do_apply_adjoint(const Vector& residual, Vector& t) override;

  std::vector<Index> pixels_;
  SplineSampling sampling_;
  ScatteredRemoval nodes_;
  Vector coefficients_;
};

/// The kernel of the spline coefficients on the lattice of every kernel.coarse-th pixel.
RemovalKernel coarse_kernel(const RemovalKernel& kernel);

/// What one apply of a CoarseRemoval gives for the times t [s]; see scattered_removal_once.
Vector coarse_removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                           const std::vector<Stroke>& strokes, const Vector& t, int threads);

}  // namespace dwell
