#pragma once

#include <string>

#include "core/tif/removal_function.h"

namespace dwell {

/// How a removal function lies on the machine. It is mirrored first (x: at the y axis, so that +x becomes -x; y
/// likewise), then turned by `angle` [deg] counter-clockwise seen from +z with x to the right and y up, both about the
/// tool axis.
struct ToolOrientation {
  enum class Flip { None, X, Y };

  double angle = 0.0;
  Flip flip = Flip::None;
};

/// "none", "x" or "y". Throws InputError.
ToolOrientation::Flip parse_flip(const std::string& text);
std::string to_string(ToolOrientation::Flip flip);

/// The removal function in that orientation. Samples are moved as they are for multiples of 90 degrees; other angles
/// take the cubic B-spline through them at the finer of both pitches on a grid with a sample on the axis, scaled so
/// that the volume rate stays. Gaussian and disc are the same in all orientations.
RemovalFunction oriented(const RemovalFunction& tif, const ToolOrientation& orientation);

}  // namespace dwell
