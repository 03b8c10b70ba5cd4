#include "core/tif/removal_apex.h"

#include <Eigen/LU>

#include <cmath>

#include "core/numerics/dense_solve.h"

namespace dwell {
namespace {

/// The value of the pixel nearest to a place; 0 off the map.
double nearest_value(const HeightMap& map, Point p) {
  const Grid& g = map.grid;
  const auto row = static_cast<Index>(std::lround((p.y - g.origin.y) / g.pitch_y)),
             col = static_cast<Index>(std::lround((p.x - g.origin.x) / g.pitch_x));
  return row < 0 || col < 0 || row >= g.rows || col >= g.cols ? 0.0 : map.at(row, col);
}

}  // namespace

std::optional<Point> rounded_apex(const HeightMap& map, double peak, Point about, double radius) {
  constexpr double kLevel = 0.7;
  constexpr double kLeastAtApex = 0.5;
  constexpr int kFewest = 9;
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  int count = 0;
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = (1.0 / radius) * (map.grid.centre(i) - about);
    const double v = map.values[static_cast<std::size_t>(i)] / peak;
    if (!(v >= kLevel) || length(p) > 1.0) continue;
    Eigen::Matrix<double, 6, 1> row;
    row << 1.0, p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y;
    normal += (v - kLevel) * row * row.transpose();
    right += (v - kLevel) * v * row;
    ++count;
  }
  if (count < kFewest) return std::nullopt;
  const Eigen::VectorXd c = least_squares(normal, right).x;
  Eigen::Matrix2d curvature;
  curvature << 2.0 * c[3], c[4], c[4], 2.0 * c[5];
  const Eigen::Vector2d at = -curvature.inverse() * Eigen::Vector2d(c[1], c[2]);
  if (!(curvature.determinant() > 0.0 && c[3] < 0.0 && at.norm() <= 1.0)) return std::nullopt;
  const Point apex = about + Point{radius * at.x(), radius * at.y()};
  if (nearest_value(map, apex) < kLeastAtApex * peak) return std::nullopt;  // the middle of a ring
  return apex;
}

}  // namespace dwell
