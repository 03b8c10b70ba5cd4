#pragma once

#include <array>
#include <vector>

#include "core/base/coarse_factor.h"
#include "core/numerics/spline_sampling.h"
#include "core/removal/removal_operator.h"

namespace dwell {

/// Normal matrices of cubic B-splines on a coarse lattice. With (S d)_i = sum_k d_k B3((x_i - x_k) / hx) B3((y_i -
/// y_k) / hy) the surface of coefficients d at pixel i, it holds sums of terms S' diag(w) S, where S may also take the
/// surface's slope along x or y, or its step from a pixel to the next one along x or y, exactly: a stencil of 7 x 7
/// numbers a node. Ragged edges and weights are summed exactly. The lattice has every factor-th line of the map and a
/// margin, so that it covers every pixel's support. The sums are held in single precision.
class SplineGram {
 public:
  /// Slopes are per pixel of the map. A step is from the pixel that is added to its neighbour at the larger x (y).
  enum class Take { Value, SlopeX, SlopeY, StepX, StepY };

  /// The zero matrix.
  SplineGram(const Grid& map, CoarseFactor factor, int threads);

  static Grid lattice_of(const Grid& map, CoarseFactor factor) { return SplineSampling::lattice_of(map, factor); }

  const Grid& lattice() const { return lattice_; }  // its nodes number the vectors below

  /// Adds scale S' diag(weights) S over the pixels, ascending linear indices; weights empty = all one. Cost about ten
  /// multiply-adds a pixel. The same bytes for any number of threads.
  void add(const std::vector<Index>& pixels, const Vector& weights, Take take, double scale);

  /// out = the matrix times d. Cost 49 multiply-adds a node.
  void apply(const Vector& d, Vector& out) const;
  /// The same for stretches of longer vectors; out has the lattice's size.
  void apply_to_stretch(const Eigen::Ref<const Vector>& d, Eigen::Ref<Vector> out) const;

  /// S' v for one value a pixel. Cost about five multiply-adds a pixel.
  void spread(const std::vector<Index>& pixels, const Vector& v, Vector& out) { sampling_.spread(pixels, v, out); }

 private:
  static constexpr Index kReach = 3;  // cubic B-splines overlap if their nodes are at most 3 apart
  static constexpr Index kWidth = 2 * kReach + 1;
  using Products = std::vector<std::array<double, 10>>;  // of the weights of a phase, pair by pair
  using Cells = std::vector<std::array<double, 100>>;
  /// What is added, and by which weights.
  struct Addend {
    const std::vector<Index>& pixels;
    const Vector& weights;
    double scale;
    const Products &along_x, &along_y;
  };

  void add_bands(const Addend& addend, Index first, Index last);
  void add_band(Cells& cells, Index first_row);
  void apply_row(Index row, const double* d, double* out) const;

  Grid map_, lattice_;
  CoarseFactor factor_;
  // (row, dy, dx, col): contiguous along columns. Single precision: reading it is what apply() costs.
  std::vector<float> stencil_;
  SplineSampling sampling_;
  int threads_;
};

}  // namespace dwell
