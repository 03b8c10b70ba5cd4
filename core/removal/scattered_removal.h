#pragma once

#include <cstdint>
#include <vector>

#include "core/motion/tool_path.h"
#include "core/numerics/padded_convolution.h"
#include "core/removal/removal_operator.h"
#include "core/tif/removal_kernel.h"

namespace dwell {

/// Removal by a tool whose strokes lie anywhere (spiral, multi-pitch, jittered, bent). Exact for the spline removal
/// function: b(x_i - p) = sum_l c_(i-l) B3(l - p/h), so each stroke is spread on the map's lattice with its averaged
/// B-spline weights and convolved with the coefficients c (docs/math.md, "Scattered dwell"). A stroke out of reach of
/// the map has an empty column. Cost of a call: one padded transform pair plus 16 or more multiply-adds a stroke.
/// Memory: the padded arrays and 24 bytes a weight; 12 bytes where the lattice has far fewer nodes than the weights
/// are.
class ScatteredRemoval final : public RemovalOperator {
 public:
  /// Throws OutOfMemory before the weights are made, if these take more than the machine has.
  ScatteredRemoval(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                   const std::vector<Stroke>& strokes, int threads);

  std::string name() const override { return "scattered"; }

 private:
  /// Sparse rows: weights and the lattice nodes (by_stroke) or strokes (by_node) they belong to.
  struct Rows {
    std::vector<Index> begin;
    std::vector<std::int32_t> index;
    std::vector<double> weight;
  };

  void do_apply(const Vector& t, Vector& removal) override;
  void do_apply_adjoint(const Vector& residual, Vector& t) override;
  void reserve_weights(double expected, double orders);
  void transpose_weights();
  void gather_by_node(const Vector& t);
  void scatter_in_blocks(const Vector& t);

  PaddedConvolution convolution_;
  Rows by_stroke_;
  Rows by_node_;                       // gathered, not scattered: no races, and one order of summation; or
  std::vector<double> block_fields_;   // what blocks of strokes scatter each for itself, summed in order
  std::vector<std::int32_t> touched_;  // field index of each row of by_node_
  int threads_;
};

/// What one apply of a ScatteredRemoval of these strokes gives for the times t [s], summed in the same order, without
/// keeping its weights: for callers that apply only once. At the pixels, in their order [nm]. Throws
/// std::invalid_argument unless there is one time a stroke. Cost: spreading the strokes, and one and a half padded
/// transform pairs. Memory: the padded arrays.
Vector scattered_removal_once(const Grid& map, const std::vector<Index>& pixels, const RemovalKernel& kernel,
                              const std::vector<Stroke>& strokes, const Vector& t, int threads);

}  // namespace dwell
