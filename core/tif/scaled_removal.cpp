#include "core/tif/scaled_removal.h"

#include <cmath>
#include <stdexcept>

namespace dwell {

RemovalFunction scaled_removal(const RemovalFunction& tif, double rate, double width) {
  if (!(rate > 0.0) || !(width > 0.0) || !std::isfinite(rate) || !std::isfinite(width))
    throw std::invalid_argument("a removal function is scaled by finite factors > 0");
  const double height = rate / (width * width);
  RemovalFunction scaled = tif;
  scaled.peak *= height;
  scaled.volume *= rate;
  scaled.fwhm *= width;
  scaled.radius *= width;
  scaled.sigma *= width;
  scaled.slope *= height / width;
  Grid& grid = scaled.samples.grid;
  grid.pitch_x *= width, grid.pitch_y *= width;
  grid.origin = width * grid.origin;
  for (double& value : scaled.samples.values) value *= height;
  return scaled;
}

}  // namespace dwell
