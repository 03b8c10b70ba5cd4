#pragma once

#include <optional>
#include <vector>

#include "core/motion/tool_path.h"
#include "core/numerics/padded_convolution.h"
#include "core/removal/removal_operator.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// Removal by a tool whose strokes are all translates of one stroke by whole pixels of the map (a regular lattice
/// commensurate with the map's grid, or any subset of one): the removal function averaged over that stroke is the
/// convolution kernel, and a dwell time is one entry of the field. Points may lie off the pixels by a common
/// fraction. A point out of reach of the map has an empty column. Cost of a call: one padded transform pair.
class LatticeRemoval final : public RemovalOperator {
 public:
  /// Throws std::invalid_argument if the strokes are not translates by whole pixels; see commensurate().
  LatticeRemoval(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                 const std::vector<Stroke>& strokes, int threads);

  /// Whether every stroke is the first one moved by whole pixels, within 1e-9 pixel.
  static bool commensurate(const Grid& map, const std::vector<Stroke>& strokes);

  std::string name() const override { return "lattice"; }

 private:
  void do_apply(const Vector& t, Vector& removal) override;
  void do_apply_adjoint(const Vector& residual, Vector& t) override;

  std::vector<Index> nodes_;  // field index of each stroke, -1 = out of reach
  std::optional<PaddedConvolution> convolution_;
};

}  // namespace dwell
