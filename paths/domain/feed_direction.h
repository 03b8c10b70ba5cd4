#pragma once

#include "core/base/point.h"

namespace dwell {

/// Unit vector of an angle [deg], counter-clockwise from +x; exact for multiples of 90 degrees, so that lines along the
/// machine's axes are exactly parallel to them. The angle is finite.
Point feed_direction(double angle_deg);

}  // namespace dwell
