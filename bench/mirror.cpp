#include "bench/mirror.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/random_numbers.h"
#include "core/numerics/fft.h"

namespace dwell::bench {
namespace {

constexpr double kSlope = -3.0;

void scale_to(std::vector<double>& values, double rms) {
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double square = 0.0;
  for (const double v : values) square += (v - mean) * (v - mean);
  const double factor = rms / std::sqrt(square / count);
  for (double& v : values) v = factor * (v - mean);
}

}  // namespace

HeightMap noise_mirror(Index n, double pitch, double rms, std::uint64_t seed) {
  const double half = 0.5 * pitch * static_cast<double>(n - 1);
  HeightMap map(Grid{n, n, pitch, pitch, {-half, -half}});
  const Index size = good_fft_size(n + n / 4);
  RealFft2D fft(size, size, 1);
  RandomNumbers random(seed);
  for (double& v : fft.real()) v = random.normal();
  fft.forward();
  const auto spectrum = fft.spectrum();
  const Index half_cols = size / 2 + 1;
  for (Index r = 0; r < size; ++r) {
    for (Index c = 0; c < half_cols; ++c) {
      const auto fy = static_cast<double>(std::min(r, size - r)), fx = static_cast<double>(c);
      const double f = std::hypot(fx, fy);
      // The amplitude is the root of the density; the mean is no error and is left out.
      spectrum[static_cast<std::size_t>(r * half_cols + c)] *= f > 0.0 ? std::pow(f, 0.5 * kSlope) : 0.0;
    }
  }
  fft.inverse();
  for (Index r = 0; r < n; ++r) {
    const auto from = fft.real().begin() + r * size;
    std::copy(from, from + n, map.values.begin() + r * n);
  }
  scale_to(map.values, rms);
  return map;
}

void cut_ring(HeightMap& map, double inner, double outer) {
  for (Index i = 0; i < map.grid.size(); ++i) {
    const double r = length(map.grid.centre(i));
    if (r < inner || r > outer) map.values[static_cast<std::size_t>(i)] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace dwell::bench
