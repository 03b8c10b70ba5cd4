#pragma once

#include "core/base/point.h"

namespace dwell {

/// An affine map of the plane: p -> (xx x + xy y, yx x + yy y) + shift [mm].
struct PlaneTransform {
  double xx = 1.0, xy = 0.0, yx = 0.0, yy = 1.0;
  Point shift;

  Point operator()(Point p) const { return {xx * p.x + xy * p.y + shift.x, yx * p.x + yy * p.y + shift.y}; }
  double determinant() const { return xx * yy - xy * yx; }
  /// Throws InputError if the transform is singular.
  PlaneTransform inverse() const;
};

/// p -> second(first(p)).
PlaneTransform composed(const PlaneTransform& second, const PlaneTransform& first);

/// p -> centre + displacement + scale R (p - centre), where R turns counter-clockwise by `degrees`.
PlaneTransform similarity(Point centre, Point displacement, double degrees, double scale);

}  // namespace dwell
