#pragma once

#include <functional>

#include "core/base/point.h"

namespace dwell {

/// The form of a removal function over the displacement from the tool axis [mm], to any scale. Not negative.
struct RemovalShape {
  std::function<double(Point)> value;
  double peak = 0.0;   // its largest value
  double reach = 0.0;  // next to no removal farther than this from the axis [mm]
};

}  // namespace dwell
