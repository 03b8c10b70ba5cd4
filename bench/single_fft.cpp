#include "bench/single_fft.h"

#include <fftw3.h>

#include <algorithm>
#include <new>

namespace dwell::bench {

struct SingleFftPair::Plans {
  float* real = nullptr;
  fftwf_complex* spectrum = nullptr;
  fftwf_plan forward = nullptr;
  fftwf_plan inverse = nullptr;

  ~Plans() {
    if (forward) fftwf_destroy_plan(forward);
    if (inverse) fftwf_destroy_plan(inverse);
    fftwf_free(real);
    fftwf_free(spectrum);
  }
};

SingleFftPair::SingleFftPair(Index size, int threads) : plans_(std::make_unique<Plans>()) {
  static const int ready = fftwf_init_threads();
  const auto n = static_cast<int>(size);
  const auto samples = static_cast<std::size_t>(size * size);
  plans_->real = fftwf_alloc_real(samples);
  plans_->spectrum = fftwf_alloc_complex(static_cast<std::size_t>(size * (size / 2 + 1)));
  if (ready == 0 || !plans_->real || !plans_->spectrum) throw std::bad_alloc();
  fftwf_plan_with_nthreads(threads);
  plans_->forward = fftwf_plan_dft_r2c_2d(n, n, plans_->real, plans_->spectrum, FFTW_ESTIMATE);
  plans_->inverse = fftwf_plan_dft_c2r_2d(n, n, plans_->spectrum, plans_->real, FFTW_ESTIMATE);
  std::fill_n(plans_->real, samples, 0.0F);
}

SingleFftPair::~SingleFftPair() = default;

void SingleFftPair::execute() {
  fftwf_execute(plans_->forward);
  fftwf_execute(plans_->inverse);
}

}  // namespace dwell::bench
