#include "core/tif/calibration/spot_registration.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numerics/dense_solve.h"

namespace dwell {
namespace {

constexpr int kRounds = 3, kSteps = 10;

/// The patch under the binomial filter 1 4 6 4 1 in x and in y. Interpolation between pixels lowers the variance of
/// white noise, which biases a least-squares shift towards half pixels; of filtered noise it lowers next to none.
SpotPatch soften_patch(SpotPatch patch) {
  constexpr std::array<double, 5> kFilter{1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
  HeightMap& map = patch.depth;
  const Index rows = map.grid.rows, cols = map.grid.cols;
  for (const bool along_rows : {true, false}) {
    const HeightMap from = map;
    for (Index r = 0; r < rows; ++r) {
      for (Index c = 0; c < cols; ++c) {
        double sum = 0.0;
        for (Index k = -2; k <= 2; ++k) {
          const Index i = along_rows ? r : std::clamp<Index>(r + k, 0, rows - 1);
          const Index j = along_rows ? std::clamp<Index>(c + k, 0, cols - 1) : c;
          sum += kFilter[static_cast<std::size_t>(k + 2)] * from.at(i, j);
        }
        map.at(r, c) = sum;
      }
    }
  }
  patch.surface = SplineSurface(map.grid, map.values);
  return patch;
}

/// The shift d for which patch(centre + d + p) comes closest to the reference at p.
Point shift_of(const SpotPatch& patch, const HeightMap& reference, double radius) {
  const Grid& g = reference.grid;
  const double hx = 0.05 * g.pitch_x, hy = 0.05 * g.pitch_y;
  Point shift;
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (Index i = 0; i < g.size(); ++i) {
      const Point p = g.centre(i);
      if (length(p) > radius) continue;
      const Point at = patch.centre + shift + p;
      const Eigen::Vector2d slope(
          (patch.surface(at + Point{hx, 0.0}) - patch.surface(at - Point{hx, 0.0})) / (2.0 * hx),
          (patch.surface(at + Point{0.0, hy}) - patch.surface(at - Point{0.0, hy})) / (2.0 * hy));
      normal += slope * slope.transpose();
      right += (reference.values[static_cast<std::size_t>(i)] - patch.surface(at)) * slope;
    }
    const Eigen::Vector2d d = least_squares(normal, right).x;
    shift = shift + Point{d.x(), d.y()};
    if (d.norm() < 1e-6 * std::min(g.pitch_x, g.pitch_y)) break;
  }
  return shift;
}

}  // namespace

SpotMean average_spots(const std::vector<SpotPatch>& patches) {
  Grid grid = patches.front().depth.grid;
  grid.origin = grid.origin - patches.front().centre;
  SpotMean result{HeightMap(grid), HeightMap(grid)};
  const double n = static_cast<double>(patches.size());
  std::vector<double> at_pixel(patches.size());
  for (Index i = 0; i < grid.size(); ++i) {
    const Point p = grid.centre(i);
    double sum = 0.0, square = 0.0;
    for (std::size_t k = 0; k < patches.size(); ++k) {
      // The first spot's own pixels are taken as they are, because the spline would change their last bits.
      at_pixel[k] =
          k == 0 ? patches[0].depth.values[static_cast<std::size_t>(i)] : patches[k].surface(patches[k].centre + p);
      sum += at_pixel[k];
    }
    for (const double v : at_pixel) square += (v - sum / n) * (v - sum / n);
    result.mean.values[static_cast<std::size_t>(i)] = sum / n;
    result.deviation.values[static_cast<std::size_t>(i)] = patches.size() > 1 ? std::sqrt(square / (n - 1.0)) : 0.0;
  }
  return result;
}

void register_spots(std::vector<SpotPatch>& patches, double radius, SpotRegistration how) {
  constexpr double kShare = 0.1;
  for (SpotPatch& patch : patches) patch.centre = spot_centroid(patch, patch.centre, radius, kShare);
  if (how == SpotRegistration::Centroid || patches.size() < 2) return;
  std::vector<SpotPatch> soft;
  soft.reserve(patches.size());
  for (const SpotPatch& patch : patches) soft.push_back(soften_patch(patch));
  for (int round = 0; round < kRounds; ++round) {
    const HeightMap reference = average_spots(soft).mean;
    std::vector<Point> shifts;
    shifts.reserve(soft.size());
    for (const SpotPatch& patch : soft) shifts.push_back(shift_of(patch, reference, radius));
    for (std::size_t k = 1; k < soft.size(); ++k) soft[k].centre = soft[k].centre + shifts[k] - shifts[0];
  }
  for (std::size_t k = 1; k < patches.size(); ++k) patches[k].centre = soft[k].centre;
}

}  // namespace dwell
