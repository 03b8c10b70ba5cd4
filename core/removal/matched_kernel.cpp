#include "core/removal/matched_kernel.h"

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

/// |spline through every factor-th sample - kernel| / |kernel|, over the kernel's own samples, or over some of them
/// where they are very many: in steps of a prime, so that they lie anywhere between the coarse nodes, where the error
/// is none.
double decimation_error(const RemovalKernel& kernel, CoarseFactor factor) {
  constexpr Index kMany = 1 << 15, kSteps[] = {1, 11, 31, 101, 311};
  const SplineSurface coarse = decimated(kernel, factor);
  double error = 0.0, norm = 0.0;
  const Grid& grid = kernel.surface.grid();
  Index step = 1;
  for (const Index s : kSteps) step = grid.size() > kMany * step ? s : step;
  for (Index i = 0; i < grid.size(); i += step) {
    const Point p = grid.centre(i);
    const double b = kernel.rate(p), e = coarse(p) - b;
    error += e * e;
    norm += b * b;
  }
  return norm > 0.0 ? std::sqrt(error / norm) : 0.0;
}

/// Farthest row or column from the middle that holds a coefficient worth keeping.
Index reach(const SplineSurface& surface, bool rows, double tail) {
  const Grid& g = surface.grid();
  const auto& c = surface.coefficients();
  double largest = 0.0;
  for (double v : c) largest = std::max(largest, std::abs(v));
  Index result = 1;
  for (Index i = 0; i < g.size(); ++i) {
    if (!(std::abs(c[static_cast<std::size_t>(i)]) > tail * largest)) continue;
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

RemovalKernel matched_kernel(const RemovalKernel& kernel, CoarseFactor factor, double tail) {
  const SplineSurface once = decimated(kernel, factor);
  const SplineSurface twice(once.grid(), once.coefficients());
  RemovalKernel result;
  result.half_rows = reach(twice, true, tail);
  result.half_cols = reach(twice, false, tail);
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

CoarseFactor coarse_factor(const RemovalKernel& kernel, double share) {
  const Grid& grid = kernel.surface.grid();
  const double pitch = share * equivalent_sigma(kernel) * std::sqrt(grid.pitch_x * grid.pitch_y);
  const auto factor = [pitch](double pixel) { return std::max<Index>(1, static_cast<Index>(pitch / pixel)); };
  return {factor(grid.pitch_x), factor(grid.pitch_y)};
}

double operator_cost(const Grid& map, const RemovalKernel& kernel) {
  if (kernel.coarse == CoarseFactor{}) return transform_cost(map, kernel);
  // Measured at 4096 x 4096 pixels: both passes over the pixels cost what so many terms of a transform do.
  constexpr double kPixelWork = 8.0;
  const auto nodes = [](Index lines, Index half, Index factor) {
    return static_cast<double>(good_fft_size((lines + 2 * half) / factor + 8));
  };
  const double n =
      nodes(map.rows, kernel.half_rows, kernel.coarse.y) * nodes(map.cols, kernel.half_cols, kernel.coarse.x);
  return n * std::log2(n) + kPixelWork * static_cast<double>(map.size());
}

}  // namespace dwell
