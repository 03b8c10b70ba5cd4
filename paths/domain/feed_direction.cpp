#include "paths/domain/feed_direction.h"

#include <cmath>
#include <numbers>

namespace dwell {

Point feed_direction(double angle_deg) {
  const double angle = std::remainder(angle_deg, 360.0);
  if (angle == 0.0) return {1.0, 0.0};
  if (std::abs(angle) == 180.0) return {-1.0, 0.0};
  if (std::abs(angle) == 90.0) return {0.0, angle > 0.0 ? 1.0 : -1.0};
  const double radians = angle * std::numbers::pi / 180.0;
  return {std::cos(radians), std::sin(radians)};
}

}  // namespace dwell
