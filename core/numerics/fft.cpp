#include "core/numerics/fft.h"

#include <fftw3.h>

#include <mutex>
#include <new>

namespace dwell {
namespace {

// The planner is the only part of FFTW that is not thread-safe.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

void initialise_threads() {
  static const int done = fftw_init_threads();
  (void)done;
}

}  // namespace

Index good_fft_size(Index n) {
  for (Index candidate = n < 1 ? 1 : n;; ++candidate) {
    Index rest = candidate;
    for (Index p : {2, 3, 5, 7}) {
      while (rest % p == 0) rest /= p;
    }
    if (rest == 1) return candidate;
  }
}

struct RealFft2D::Plans {
  double* real = nullptr;
  fftw_complex* spectrum = nullptr;
  fftw_plan forward = nullptr;
  fftw_plan inverse = nullptr;

  ~Plans() {
    const std::lock_guard lock(planner_mutex());
    if (forward) fftw_destroy_plan(forward);
    if (inverse) fftw_destroy_plan(inverse);
    fftw_free(real);
    fftw_free(spectrum);
  }
};

RealFft2D::RealFft2D(Index rows, Index cols, int threads)
    : rows_(rows), cols_(cols), plans_(std::make_unique<Plans>()) {
  const auto n0 = static_cast<int>(rows), n1 = static_cast<int>(cols);
  const std::lock_guard lock(planner_mutex());
  initialise_threads();
  plans_->real = fftw_alloc_real(static_cast<std::size_t>(rows * cols));
  plans_->spectrum = fftw_alloc_complex(static_cast<std::size_t>(rows * (cols / 2 + 1)));
  if (!plans_->real || !plans_->spectrum) throw std::bad_alloc();
  fftw_plan_with_nthreads(threads);
  plans_->forward = fftw_plan_dft_r2c_2d(n0, n1, plans_->real, plans_->spectrum, FFTW_ESTIMATE);
  plans_->inverse = fftw_plan_dft_c2r_2d(n0, n1, plans_->spectrum, plans_->real, FFTW_ESTIMATE);
}

RealFft2D::~RealFft2D() = default;
RealFft2D::RealFft2D(RealFft2D&&) noexcept = default;
RealFft2D& RealFft2D::operator=(RealFft2D&&) noexcept = default;

std::span<double> RealFft2D::real() { return {plans_->real, static_cast<std::size_t>(rows_ * cols_)}; }

std::span<std::complex<double>> RealFft2D::spectrum() {
  return {reinterpret_cast<std::complex<double>*>(plans_->spectrum), static_cast<std::size_t>(rows_ * (cols_ / 2 + 1))};
}

void RealFft2D::forward() { fftw_execute(plans_->forward); }
void RealFft2D::inverse() { fftw_execute(plans_->inverse); }

}  // namespace dwell
