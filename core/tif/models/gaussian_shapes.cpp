#include "core/tif/models/gaussian_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/rotation.h"

namespace dwell {
namespace {

constexpr double kLn2 = std::numbers::ln2;
constexpr double kReachInWidths = 1.5;  // exp(-9 ln 2) = 0.002 there

}  // namespace

RemovalShape elliptic_gaussian_shape(double fwhm_x, double fwhm_y, double angle) {
  const Rotation turn(angle);
  return {[=](Point p) {
            const Point q = turn.back(p);
            const double u = 2.0 * q.x / fwhm_x, v = 2.0 * q.y / fwhm_y;
            return std::exp(-kLn2 * (u * u + v * v));
          },
          1.0, kReachInWidths * std::max(fwhm_x, fwhm_y)};
}

RemovalShape super_gaussian_shape(double fwhm, double order) {
  return {[=](Point p) { return std::exp(-kLn2 * std::pow(2.0 * length(p) / fwhm, order)); }, 1.0,
          0.5 * fwhm * std::pow(9.0, 1.0 / order)};
}

RemovalShape mrf_shape(double lead, double trail, double width, double angle) {
  const Rotation turn(angle);
  return {[=](Point p) {
            const Point q = turn.back(p);
            const double u = q.x / (q.x < 0.0 ? lead : trail), v = 2.0 * q.y / width;
            return std::exp(-kLn2 * (u * u + v * v));
          },
          1.0, 2.0 * kReachInWidths * std::max({lead, trail, 0.5 * width})};
}

}  // namespace dwell
