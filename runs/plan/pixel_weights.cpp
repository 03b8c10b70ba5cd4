#include "runs/plan/pixel_weights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/anatomy/edge_zone.h"

namespace dwell {

std::vector<double> weights_at_edge(const HeightMap& part, double width, double weight, int threads) {
  const EdgeZone zone = edge_zone(part, width / kEdgeZoneInFwhm, threads);
  std::vector<double> weights(part.values.size(), 1.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (zone.holds[i] != 0) weights[i] = weight;
  }
  return weights;
}

std::vector<double> weights_in_centre(const HeightMap& part, double weight) {
  const Grid& g = part.grid;
  Index top = g.rows, bottom = -1, left = g.cols, right = -1;
  for (const Index pixel : finite_pixels(part)) {
    const Index row = pixel / g.cols, col = pixel % g.cols;
    top = std::min(top, row), bottom = std::max(bottom, row);
    left = std::min(left, col), right = std::max(right, col);
  }
  std::vector<double> weights(part.values.size(), 1.0);
  for (Index row = top; row <= bottom; ++row) {
    const double v = static_cast<double>(2 * row - top - bottom) / static_cast<double>(bottom - top + 1);
    for (Index col = left; col <= right; ++col) {
      const double u = static_cast<double>(2 * col - left - right) / static_cast<double>(right - left + 1);
      const double rho = std::hypot(u, v), fall = std::cos(0.5 * std::numbers::pi * rho);
      if (rho < 1.0) weights[static_cast<std::size_t>(g.index(row, col))] = 1.0 + (weight - 1.0) * fall * fall;
    }
  }
  return weights;
}

}  // namespace dwell
