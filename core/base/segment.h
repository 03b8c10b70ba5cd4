#pragma once

#include <algorithm>

#include "core/base/point.h"

namespace dwell {

/// The distance of a point from the straight way between two others [mm]; from one of them where these are equal.
inline double distance_to_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double squared = dot(along, along);
  const double share = squared > 0.0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return distance(p, a + share * along);
}

}  // namespace dwell
