#pragma once

#include <cmath>
#include <numbers>

#include "core/base/point.h"

namespace dwell {

/// A rotation by an angle [deg], counter-clockwise seen from +z with x to the right and y up.
class Rotation {
 public:
  explicit Rotation(double degrees)
      : cosine_(std::cos(degrees * std::numbers::pi / 180.0)), sine_(std::sin(degrees * std::numbers::pi / 180.0)) {}

  Point operator()(Point p) const { return {cosine_ * p.x - sine_ * p.y, sine_ * p.x + cosine_ * p.y}; }
  Point back(Point p) const { return {cosine_ * p.x + sine_ * p.y, -sine_ * p.x + cosine_ * p.y}; }

 private:
  double cosine_, sine_;
};

}  // namespace dwell
