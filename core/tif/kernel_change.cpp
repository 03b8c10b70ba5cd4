#include "core/tif/kernel_change.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/tif/scaled_removal.h"

namespace dwell {
namespace {

double sum_of_squares(const SplineSurface& surface) {
  const Grid& grid = surface.grid();
  double squares = 0.0;
  for (Index i = 0; i < grid.size(); ++i) {
    const double value = surface(grid.centre(i));
    squares += value * value;
  }
  return squares;
}

/// A kernel of these coefficients, about the axis in their middle, on the lattice of another.
RemovalKernel on_lattice_of(const RemovalKernel& other, SplineSurface surface) {
  RemovalKernel kernel = other;
  kernel.half_rows = surface.grid().rows / 2, kernel.half_cols = surface.grid().cols / 2;
  kernel.energy = sum_of_squares(surface);
  kernel.surface = std::move(surface);
  return kernel;
}

/// Adds coefficients about the axis to those on a grid that holds them.
void add_about_axis(const SplineSurface& surface, double factor, const Grid& grid, std::vector<double>& sum) {
  const Grid& from = surface.grid();
  const Index row = grid.rows / 2 - from.rows / 2, col = grid.cols / 2 - from.cols / 2;
  for (Index i = 0; i < from.size(); ++i) {
    const Index at = grid.index(row + i / from.cols, col + i % from.cols);
    sum[static_cast<std::size_t>(at)] += factor * surface.coefficients()[static_cast<std::size_t>(i)];
  }
}

}  // namespace

RemovalKernel kernel_by_width(const RemovalFunction& tif, const RemovalKernel& kernel, double hx, double hy) {
  constexpr double kStep = 0.02, kFewestPixels = 2.0;
  const double least = tif.fwhm * (1.0 - kStep) >= kFewestPixels * std::max(hx, hy) ? 1.0 - kStep : 1.0;
  const RemovalKernel wide = pixel_kernel(scaled_removal(tif, 1.0, 1.0 + kStep), hx, hy, kernel.division);
  const RemovalKernel narrow = pixel_kernel(scaled_removal(tif, 1.0, least), hx, hy, kernel.division);
  Grid grid = wide.surface.grid();
  grid.rows = std::max(grid.rows, narrow.surface.grid().rows);
  grid.cols = std::max(grid.cols, narrow.surface.grid().cols);
  grid.origin = {-grid.pitch_x * static_cast<double>(grid.cols / 2),
                 -grid.pitch_y * static_cast<double>(grid.rows / 2)};
  std::vector<double> change(static_cast<std::size_t>(grid.size()), 0.0);
  const double per_width = 1.0 / (1.0 + kStep - least);
  add_about_axis(wide.surface, per_width, grid, change);
  add_about_axis(narrow.surface, -per_width, grid, change);
  return on_lattice_of(kernel, SplineSurface::with_coefficients(grid, std::move(change)));
}

RemovalKernel kernel_by_shift(const RemovalKernel& kernel, ShiftAxis axis) {
  const Grid& grid = kernel.surface.grid();
  std::vector<double> slopes(static_cast<std::size_t>(grid.size()));
  for (Index i = 0; i < grid.size(); ++i) {
    const SplineSurface::Jet jet = kernel.surface.jet(grid.centre(i));
    slopes[static_cast<std::size_t>(i)] = axis == ShiftAxis::X ? jet.by_x : jet.by_y;
  }
  return on_lattice_of(kernel, SplineSurface(grid, slopes));
}

RemovalKernel times(RemovalKernel kernel, double factor) {
  std::vector<double> coefficients = kernel.surface.coefficients();
  for (double& c : coefficients) c *= factor;
  kernel.surface = SplineSurface::with_coefficients(kernel.surface.grid(), std::move(coefficients));
  kernel.volume_factor *= factor;
  kernel.energy *= factor * factor;
  return kernel;
}

}  // namespace dwell
