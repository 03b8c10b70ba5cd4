#pragma once

namespace dwell {

/// A mirror that images one focus of an ellipse into the other.
struct EllipseMirror {
  double entrance_arm = 0.0;  // p, from the source to the pole [mm]
  double exit_arm = 0.0;      // q, from the pole to the image [mm]
  double grazing = 0.0;       // angle between ray and tangent at the pole [rad], within (0, pi/2]
};

struct EllipsePoint {
  double height = 0.0;  // over the tangent, towards the foci [mm]
  double slope = 0.0;   // its derivative along the tangent
};

/// Height and slope of the mirror at a place u [mm] along its tangent at the pole, the source at negative u. Both are
/// NaN where the ellipse has no such point.
///
/// With the foci at (-p cos t, p sin t) and (q cos t, q sin t), a point (u, z) of the ellipse has distances to them
/// whose sum is p + q. The difference of their squares is linear in u and z, and gives the distance to the image as
/// q - u cos t + e z with e = sin t (p - q) / (p + q). Squared, this is a z^2 - 2 (b0 - e cos t u) z + sin^2 t u^2 = 0
/// with a = 1 - e^2 and b0 = 2 p q sin t / (p + q). With b = b0 - e cos t u and r = sqrt(b^2 - a sin^2 t u^2), the
/// root at the pole is z = sin^2 t u^2 / (b + r), which loses no digits, and its slope (sin^2 t u + e cos t z) / r.
EllipsePoint ellipse_at(const EllipseMirror& mirror, double u);

}  // namespace dwell
