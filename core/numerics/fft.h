#pragma once

#include <complex>
#include <memory>
#include <span>

#include "core/base/grid.h"

namespace dwell {

/// Smallest n' >= n of the form 2^a 3^b 5^c 7^d: sizes for which the transform is fast.
Index good_fft_size(Index n);

/// A real two-dimensional discrete Fourier transform of fixed size with its own buffers. Unnormalised: inverse after
/// forward multiplies by rows * cols. Plans are estimated, not measured, so that equal input gives equal bytes.
/// Not thread-safe: one object, one caller; each transform itself runs on `threads` threads.
class RealFft2D {
 public:
  RealFft2D(Index rows, Index cols, int threads);
  ~RealFft2D();
  RealFft2D(RealFft2D&&) noexcept;
  RealFft2D& operator=(RealFft2D&&) noexcept;

  Index rows() const { return rows_; }
  Index cols() const { return cols_; }
  std::span<double> real();                    // rows x cols, row-major
  std::span<std::complex<double>> spectrum();  // rows x (cols/2 + 1)
  void forward();                              // real -> spectrum; keeps real
  void inverse();                              // spectrum -> real; destroys spectrum

 private:
  struct Plans;
  Index rows_, cols_;
  std::unique_ptr<Plans> plans_;
};

}  // namespace dwell
