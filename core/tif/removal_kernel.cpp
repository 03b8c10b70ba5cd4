#include "core/tif/removal_kernel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/errors.h"

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

RemovalKernel removal_kernel(const RemovalFunction& tif, double pitch_x, double pitch_y) {
  if (!(tif.fwhm >= 2.0 * std::max(pitch_x, pitch_y))) {
    throw InputError(
        fmt::format("removal function: FWHM = {:.4g} mm is narrower than two pixels of the map ({:.4g} x {:.4g} mm); "
                    "check `tif pixel` and `map pixel`",
                    tif.fwhm, pitch_x, pitch_y));
  }
  const auto half = [&](double pitch) { return static_cast<Index>(std::ceil(tif.radius / pitch - 1e-6)); };
  const Index rx = half(pitch_x), ry = half(pitch_y);
  const Grid grid{2 * ry + 1,
                  2 * rx + 1,
                  pitch_x,
                  pitch_y,
                  {-pitch_x * static_cast<double>(rx), -pitch_y * static_cast<double>(ry)}};
  const auto rate = rate_at_pixel(tif, pitch_x, pitch_y);
  std::vector<double> samples(static_cast<std::size_t>(grid.size()));
  double sum = 0.0;
  for (Index i = 0; i < grid.size(); ++i) {
    // Exact multiples of the pitch, so that the axis falls on a sample to the last bit.
    const Point p{pitch_x * static_cast<double>(i % grid.cols - rx), pitch_y * static_cast<double>(i / grid.cols - ry)};
    samples[static_cast<std::size_t>(i)] = rate(p);
    sum += samples[static_cast<std::size_t>(i)];
  }
  RemovalKernel kernel;
  kernel.volume_factor = tif.volume / (sum * pitch_x * pitch_y);
  if (!(kernel.volume_factor >= 0.9 && kernel.volume_factor <= 1.1)) {
    throw InputError(
        fmt::format("removal function: its volume on the map's pitch of {:.4g} x {:.4g} mm is off by a factor {:.4g}; "
                    "the map is too coarse for this removal function",
                    pitch_x, pitch_y, 1.0 / kernel.volume_factor));
  }
  for (double& s : samples) {
    s *= kernel.volume_factor;
    kernel.energy += s * s;
  }
  kernel.surface = SplineSurface(grid, samples);
  kernel.half_rows = ry + SplineSurface::kMargin;
  kernel.half_cols = rx + SplineSurface::kMargin;
  return kernel;
}

}  // namespace dwell
