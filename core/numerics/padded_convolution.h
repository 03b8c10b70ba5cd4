#pragma once

#include <complex>
#include <span>
#include <vector>

#include "core/base/grid.h"
#include "core/numerics/fft.h"

namespace dwell {

/// Linear (not periodic) convolution of a field on the map's lattice, widened by the kernel's half size on every side,
/// with a kernel on the same lattice; only the map's own pixels of the result are right, and only they are read.
/// LatticeRemoval and ScatteredRemoval both use it. Memory: two padded arrays and the kernel's spectrum.
class PaddedConvolution {
 public:
  /// kernel: (2 half_rows + 1) x (2 half_cols + 1), row-major, centre at (half_rows, half_cols).
  /// pixels: linear indices into the map of the pixels that are read and written.
  PaddedConvolution(const Grid& map, const std::vector<Index>& pixels, const std::vector<double>& kernel,
                    Index half_rows, Index half_cols, int threads);

  /// Index into field() of map lattice node (row, col), or -1 if the kernel carries the node to no pixel of the map.
  /// Nodes outside the map are allowed.
  Index node(Index row, Index col) const {
    const Index r = row + half_rows_, c = col + half_cols_;
    if (r < 0 || c < 0 || r >= map_.rows + 2 * half_rows_ || c >= map_.cols + 2 * half_cols_) return -1;
    return r * fft_.cols() + c;
  }

  /// By how many nodes the lattice is wider than the map on every side.
  Index half_rows() const { return half_rows_; }
  Index half_cols() const { return half_cols_; }

  std::span<double> field() { return fft_.real(); }
  void clear_field();

  /// field <- kernel * field; then reads the result at the pixels.
  void convolve(double* at_pixels);
  /// field <- adjoint of the above: values at the pixels, zero elsewhere, correlated with the kernel.
  void correlate(const double* at_pixels);

 private:
  template <bool Conjugate>
  void multiply();

  Grid map_;
  Index half_rows_, half_cols_;
  RealFft2D fft_;
  std::vector<std::complex<double>> spectrum_;  // of the kernel, with the transform's 1/N
  std::vector<Index> pixel_nodes_;
  int threads_;
};

}  // namespace dwell
