#include "core/numerics/padded_convolution.h"

#include <algorithm>

namespace dwell {
namespace {

Index wrapped(Index i, Index n) { return i < 0 ? i + n : i; }

}  // namespace

PaddedConvolution::PaddedConvolution(const Grid& map, const std::vector<Index>& pixels,
                                     const std::vector<double>& kernel, Index half_rows, Index half_cols, int threads)
    : map_(map),
      half_rows_(half_rows),
      half_cols_(half_cols),
      // A kernel that reaches half either way couples nodes at most cols - 1 + half apart: cols + 2 half suffices.
      fft_(good_fft_size(map.rows + 2 * half_rows), good_fft_size(map.cols + 2 * half_cols), threads),
      threads_(threads) {
  clear_field();
  const auto field = fft_.real();
  for (Index r = -half_rows; r <= half_rows; ++r) {
    for (Index c = -half_cols; c <= half_cols; ++c) {
      const auto from = static_cast<std::size_t>((r + half_rows) * (2 * half_cols + 1) + c + half_cols);
      field[static_cast<std::size_t>(wrapped(r, fft_.rows()) * fft_.cols() + wrapped(c, fft_.cols()))] = kernel[from];
    }
  }
  fft_.forward();
  spectrum_.assign(fft_.spectrum().begin(), fft_.spectrum().end());
  const double scale = 1.0 / static_cast<double>(fft_.rows() * fft_.cols());
  for (auto& s : spectrum_) s *= scale;
  pixel_nodes_.reserve(pixels.size());
  for (Index pixel : pixels) pixel_nodes_.push_back(node(pixel / map.cols, pixel % map.cols));
}

void PaddedConvolution::clear_field() {
  const auto field = fft_.real();
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index r = 0; r < fft_.rows(); ++r) std::fill_n(field.data() + r * fft_.cols(), fft_.cols(), 0.0);
}

template <bool Conjugate>
void PaddedConvolution::multiply() {
  // Written out, because std::complex's operator* handles infinities, which keeps the compiler from vectorising the
  // loop.
  auto* field = reinterpret_cast<double*>(fft_.spectrum().data());
  const auto* kernel = reinterpret_cast<const double*>(spectrum_.data());
  const auto n = static_cast<Index>(spectrum_.size());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index i = 0; i < n; ++i) {
    const double a = field[2 * i], b = field[2 * i + 1];
    const double c = kernel[2 * i], d = Conjugate ? -kernel[2 * i + 1] : kernel[2 * i + 1];
    field[2 * i] = a * c - b * d;
    field[2 * i + 1] = a * d + b * c;
  }
}

void PaddedConvolution::convolve(double* at_pixels) {
  fft_.forward();
  multiply<false>();
  fft_.inverse();
  const double* field = fft_.real().data();
  const auto m = static_cast<Index>(pixel_nodes_.size());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index i = 0; i < m; ++i) at_pixels[i] = field[pixel_nodes_[static_cast<std::size_t>(i)]];
}

void PaddedConvolution::correlate(const double* at_pixels) {
  clear_field();
  double* field = fft_.real().data();
  const auto m = static_cast<Index>(pixel_nodes_.size());
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (Index i = 0; i < m; ++i) field[pixel_nodes_[static_cast<std::size_t>(i)]] = at_pixels[i];
  fft_.forward();
  multiply<true>();
  fft_.inverse();
}

}  // namespace dwell
