#include "core/map/robust_plane.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/numerics/dense_solve.h"
#include "core/numerics/median.h"

namespace dwell {
namespace {

constexpr std::size_t kMostPixels = 200'000;
constexpr int kPasses = 20;

struct Sample {
  double x, y, z;
};

double residual(const Sample& s, const Eigen::Vector3d& c) { return s.z - c[0] - c[1] * s.x - c[2] * s.y; }

double scatter_of(const std::vector<Sample>& samples, const Eigen::Vector3d& c) {
  std::vector<double> sizes;
  sizes.reserve(samples.size());
  for (const Sample& s : samples) sizes.push_back(std::abs(residual(s, c)));
  return kSigmaPerMedianDeviation * upper_median(std::move(sizes));
}

template <class Weight>
Eigen::Vector3d weighted_fit(const std::vector<Sample>& samples, const Eigen::Vector3d& before, bool tilt,
                             const Weight& weight) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Sample& s : samples) {
    const double w = weight(residual(s, before));
    const Eigen::Vector3d row(1.0, tilt ? s.x : 0.0, tilt ? s.y : 0.0);
    normal += w * row * row.transpose();
    right += w * s.z * row;
  }
  // Smallest solution where the pixels leave the slope open; x and y are of size one.
  return least_squares(normal, right, 1e-9).x;
}

}  // namespace

Plane robust_plane(const HeightMap& map, const std::vector<Index>& pixels, bool tilt) {
  if (pixels.size() < 3) throw std::invalid_argument("robust_plane needs three pixels");
  const std::size_t step = (pixels.size() + kMostPixels - 1) / kMostPixels;
  Plane plane;
  const double extent = std::max(map.grid.width(), map.grid.height());
  plane.centre = map.grid.centre(pixels[pixels.size() / 2]);
  std::vector<Sample> samples;
  std::vector<double> heights;
  for (std::size_t k = 0; k < pixels.size(); k += step) {
    const Point d = map.grid.centre(pixels[k]) - plane.centre;
    const double z = map.values[static_cast<std::size_t>(pixels[k])];
    samples.push_back({d.x / extent, d.y / extent, z});
    heights.push_back(z);
  }
  Eigen::Vector3d c(upper_median(std::move(heights)), 0.0, 0.0);
  for (int k = 0; k < kPasses; ++k) {
    const double floor = std::max(1e-3 * scatter_of(samples, c), 1e-300);
    c = weighted_fit(samples, c, tilt, [&](double r) { return 1.0 / std::max(std::abs(r), floor); });
  }
  for (int k = 0; k < kPasses; ++k) {
    const double limit = 4.685 * scatter_of(samples, c);
    if (!(limit > 0.0)) break;  // more than half lie on the plane
    c = weighted_fit(samples, c, tilt, [&](double r) {
      const double q = 1.0 - (r / limit) * (r / limit);
      return q > 0.0 ? q * q : 0.0;
    });
  }
  plane.level = c[0];
  plane.slope = {c[1] / extent, c[2] / extent};
  plane.scatter = scatter_of(samples, c);
  return plane;
}

}  // namespace dwell
