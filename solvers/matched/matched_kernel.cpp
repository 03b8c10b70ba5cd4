#include "solvers/matched/matched_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numerics/fft.h"

namespace dwell {
namespace {

/// The spline through every factor-th sample of the kernel about its axis.
SplineSurface decimated(const RemovalKernel& kernel, CoarseFactor factor) {
  const Grid& fine = kernel.surface.grid();
  const Index rx = kernel.half_cols / factor.x + 1, ry = kernel.half_rows / factor.y + 1;
  Grid grid{2 * ry + 1,
            2 * rx + 1,
            fine.pitch_x * static_cast<double>(factor.x),
            fine.pitch_y * static_cast<double>(factor.y),
            {}};
  grid.origin = {-grid.pitch_x * static_cast<double>(rx), -grid.pitch_y * static_cast<double>(ry)};
  std::vector<double> samples(static_cast<std::size_t>(grid.size()));
  for (Index i = 0; i < grid.size(); ++i) samples[static_cast<std::size_t>(i)] = kernel.rate(grid.centre(i));
  return SplineSurface(grid, samples);
}

/// |spline through every factor-th sample - kernel| / |kernel|, over the kernel's own samples.
double decimation_error(const RemovalKernel& kernel, CoarseFactor factor) {
  const SplineSurface coarse = decimated(kernel, factor);
  double error = 0.0, norm = 0.0;
  const Grid& grid = kernel.surface.grid();
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i);
    const double b = kernel.rate(p), e = coarse(p) - b;
    error += e * e;
    norm += b * b;
  }
  return norm > 0.0 ? std::sqrt(error / norm) : 0.0;
}

/// Farthest row or column from the middle that holds a coefficient worth keeping.
Index reach(const SplineSurface& surface, bool rows) {
  const Grid& g = surface.grid();
  const auto& c = surface.coefficients();
  double largest = 0.0;
  for (double v : c) largest = std::max(largest, std::abs(v));
  Index result = 1;
  for (Index i = 0; i < g.size(); ++i) {
    if (!(std::abs(c[static_cast<std::size_t>(i)]) > 1e-5 * largest)) continue;
    result = std::max(result, rows ? std::abs(i / g.cols - g.rows / 2) : std::abs(i % g.cols - g.cols / 2));
  }
  return result;
}

}  // namespace

CoarseFactor matched_factor(const RemovalKernel& kernel, double tolerance) {
  // Equal pitch both ways, as near as whole pixels allow.
  const Grid& grid = kernel.surface.grid();
  const double pitch = std::min(grid.pitch_x, grid.pitch_y);
  const auto factor = [&](Index q) {
    const double coarse = pitch * static_cast<double>(q);
    return CoarseFactor{std::max<Index>(1, std::llround(coarse / grid.pitch_x)),
                        std::max<Index>(1, std::llround(coarse / grid.pitch_y))};
  };
  Index best = 1;
  for (Index q = 2; q <= std::max(kernel.half_rows, kernel.half_cols); ++q) {
    if (!(decimation_error(kernel, factor(q)) <= tolerance)) break;
    best = q;
  }
  return factor(best);
}

RemovalKernel matched_kernel(const RemovalKernel& kernel, CoarseFactor factor) {
  const SplineSurface once = decimated(kernel, factor);
  const SplineSurface twice(once.grid(), once.coefficients());
  RemovalKernel result;
  result.half_rows = reach(twice, true);
  result.half_cols = reach(twice, false);
  const Grid& g = twice.grid();
  Grid cut = g;
  cut.rows = 2 * result.half_rows + 1;
  cut.cols = 2 * result.half_cols + 1;
  const Index first_row = g.rows / 2 - result.half_rows, first_col = g.cols / 2 - result.half_cols;
  cut.origin = g.centre(first_row, first_col);
  std::vector<double> kept;
  kept.reserve(static_cast<std::size_t>(cut.size()));
  for (Index r = 0; r < cut.rows; ++r) {
    const auto row = twice.coefficients().begin() + g.index(first_row + r, first_col);
    kept.insert(kept.end(), row, row + cut.cols);
  }
  result.surface = SplineSurface::with_coefficients(cut, std::move(kept));
  return result;
}

double equivalent_sigma(const RemovalKernel& kernel) {
  double volume = 0.0;
  for (double c : kernel.surface.coefficients()) volume += c;
  return std::abs(volume) / std::sqrt(4.0 * std::numbers::pi * kernel.energy);
}

double transform_cost(const Grid& map, const RemovalKernel& kernel) {
  const auto n = static_cast<double>(good_fft_size(map.rows + 2 * kernel.half_rows)) *
                 static_cast<double>(good_fft_size(map.cols + 2 * kernel.half_cols));
  return n * std::log2(n);
}

}  // namespace dwell
