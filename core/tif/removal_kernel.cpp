#include "core/tif/removal_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/base/errors.h"
#include "core/tif/pixel_mean.h"

namespace dwell {
namespace {

/// Mean of slope * r inside the disc over one pixel, by 16 x 16 midpoints: the rim is a jump, whose place would depend
/// on the grid if it were sampled at points.
double disc_pixel_mean(const RemovalFunction& tif, Point centre, double hx, double hy) {
  constexpr int kSub = 16;
  double sum = 0.0;
  for (int i = 0; i < kSub; ++i) {
    for (int j = 0; j < kSub; ++j) {
      const double x = centre.x + hx * ((j + 0.5) / kSub - 0.5);
      const double y = centre.y + hy * ((i + 0.5) / kSub - 0.5);
      const double r = std::hypot(x, y);
      if (r <= tif.radius) sum += tif.slope * r;
    }
  }
  return sum / (kSub * kSub);
}

}  // namespace

std::function<double(Point)> rate_at_pixel(const RemovalFunction& tif, double hx, double hy) {
  switch (tif.kind) {
    case RemovalFunction::Kind::Gaussian:
      return [&tif](Point p) {
        const double r2 = p.x * p.x + p.y * p.y;
        return r2 <= tif.radius * tif.radius ? tif.peak * std::exp(-0.5 * r2 / (tif.sigma * tif.sigma)) : 0.0;
      };
    case RemovalFunction::Kind::Disc:
      return [&tif, hx, hy](Point p) { return disc_pixel_mean(tif, p, hx, hy); };
    case RemovalFunction::Kind::Measured:
    case RemovalFunction::Kind::Model:
      break;
  }
  return SplineSurface(tif.samples.grid, tif.samples.values);
}

namespace {

void require_width(const RemovalFunction& tif, double hx, double hy) {
  if (tif.fwhm >= 2.0 * std::max(hx, hy)) return;
  throw InputError(
      fmt::format("removal function: FWHM = {:.4g} mm is narrower than two pixels of the map ({:.4g} x {:.4g} mm); "
                  "check `tif pixel` and `map pixel`",
                  tif.fwhm, hx, hy));
}

/// Samples on a lattice whose middle is the tool axis.
struct KernelSamples {
  Grid grid;
  std::vector<double> values;
};

/// Exact multiples of the pitch, so that the axis falls on a sample to the last bit.
KernelSamples sample_about_axis(const std::function<double(Point)>& rate, Index half_rows, Index half_cols,
                                double pitch_x, double pitch_y) {
  KernelSamples samples;
  samples.grid = {2 * half_rows + 1,
                  2 * half_cols + 1,
                  pitch_x,
                  pitch_y,
                  {-pitch_x * static_cast<double>(half_cols), -pitch_y * static_cast<double>(half_rows)}};
  samples.values.reserve(static_cast<std::size_t>(samples.grid.size()));
  for (Index r = -half_rows; r <= half_rows; ++r) {
    for (Index c = -half_cols; c <= half_cols; ++c)
      samples.values.push_back(rate({pitch_x * static_cast<double>(c), pitch_y * static_cast<double>(r)}));
  }
  return samples;
}

/// Without the outer rows and columns in which nothing is worth keeping.
KernelSamples trimmed(const KernelSamples& samples) {
  constexpr double kWorthKeeping = 1e-5;  // of the largest
  const Grid& g = samples.grid;
  double largest = 0.0;
  for (const double v : samples.values) largest = std::max(largest, std::abs(v));
  Index half_rows = 0, half_cols = 0;
  for (Index i = 0; i < g.size(); ++i) {
    if (!(std::abs(samples.values[static_cast<std::size_t>(i)]) > kWorthKeeping * largest)) continue;
    half_rows = std::max(half_rows, std::abs(i / g.cols - g.rows / 2));
    half_cols = std::max(half_cols, std::abs(i % g.cols - g.cols / 2));
  }
  const Index first_row = g.rows / 2 - half_rows, first_col = g.cols / 2 - half_cols;
  KernelSamples kept;
  kept.grid = {2 * half_rows + 1, 2 * half_cols + 1, g.pitch_x, g.pitch_y, g.centre(first_row, first_col)};
  kept.values.reserve(static_cast<std::size_t>(kept.grid.size()));
  for (Index r = 0; r < kept.grid.rows; ++r) {
    const auto row = samples.values.begin() + g.index(first_row + r, first_col);
    kept.values.insert(kept.values.end(), row, row + kept.grid.cols);
  }
  return kept;
}

/// Scales the samples to the volume rate and lays the spline through them.
RemovalKernel kernel_of(KernelSamples samples, double volume) {
  const Grid& g = samples.grid;
  const double sum = std::accumulate(samples.values.begin(), samples.values.end(), 0.0);
  RemovalKernel kernel;
  kernel.volume_factor = volume / (sum * g.pitch_x * g.pitch_y);
  for (double& s : samples.values) {
    s *= kernel.volume_factor;
    kernel.energy += s * s;
  }
  kernel.surface = SplineSurface(g, samples.values);
  kernel.half_rows = g.rows / 2 + SplineSurface::kMargin;
  kernel.half_cols = g.cols / 2 + SplineSurface::kMargin;
  return kernel;
}

Index samples_beyond_axis(double radius, double pitch) { return static_cast<Index>(std::ceil(radius / pitch - 1e-6)); }

/// How far the removal function reaches along x and y [mm]: the spline through samples reaches beyond them.
Point reach_of(const RemovalFunction& tif) {
  using Kind = RemovalFunction::Kind;
  if (tif.kind == Kind::Gaussian || tif.kind == Kind::Disc) return {tif.radius, tif.radius};
  const Grid& g = tif.samples.grid;
  constexpr double kBeyond = SplineSurface::kMargin + 2;
  const auto farthest = [](double first, double pitch, Index count) {
    return std::max(std::abs(first - kBeyond * pitch),
                    std::abs(first + (static_cast<double>(count - 1) + kBeyond) * pitch));
  };
  return {farthest(g.origin.x, g.pitch_x, g.cols), farthest(g.origin.y, g.pitch_y, g.rows)};
}

}  // namespace

RemovalKernel pixel_kernel(const RemovalFunction& tif, double hx, double hy, PixelDivision division) {
  require_width(tif, hx, hy);
  const double pitch_x = hx / static_cast<double>(division.x), pitch_y = hy / static_cast<double>(division.y);
  const Point reach = reach_of(tif);
  const KernelSamples samples =
      sample_about_axis(mean_rate_over_pixel(tif, hx, hy), samples_beyond_axis(reach.y + 0.5 * hy, pitch_y),
                        samples_beyond_axis(reach.x + 0.5 * hx, pitch_x), pitch_x, pitch_y);
  RemovalKernel kernel = kernel_of(trimmed(samples), tif.volume);
  kernel.division = division;
  return kernel;
}

RemovalKernel removal_kernel(const RemovalFunction& tif, double pitch_x, double pitch_y) {
  require_width(tif, pitch_x, pitch_y);
  RemovalKernel kernel =
      kernel_of(sample_about_axis(rate_at_pixel(tif, pitch_x, pitch_y), samples_beyond_axis(tif.radius, pitch_y),
                                  samples_beyond_axis(tif.radius, pitch_x), pitch_x, pitch_y),
                tif.volume);
  if (!(kernel.volume_factor >= 0.9 && kernel.volume_factor <= 1.1)) {
    throw InputError(
        fmt::format("removal function: its volume on the map's pitch of {:.4g} x {:.4g} mm is off by a factor {:.4g}; "
                    "the map is too coarse for this removal function",
                    pitch_x, pitch_y, 1.0 / kernel.volume_factor));
  }
  return kernel;
}

}  // namespace dwell
