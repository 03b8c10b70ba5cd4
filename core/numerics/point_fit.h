#pragma once

#include <string>
#include <vector>

#include "core/numerics/plane_transform.h"

namespace dwell {

/// What may move to bring one set of points onto another.
enum class PointFitKind {
  Shift,       // 1 pair at least
  Rigid,       // shift and rotation: 2 pairs
  Similarity,  // and scale: 2 pairs
  Affine,      // any linear map: 3 pairs not on one line
};

/// "shift", "rigid", "similarity" or "affine". Throws InputError.
PointFitKind parse_point_fit_kind(const std::string& text);

/// The same mark in two frames [mm].
struct PointPair {
  Point from, to;
};

struct PointFit {
  PlaneTransform transform;
  std::vector<Point> residuals;  // to - transform(from), a pair each [mm]
  double rms = 0.0;              // of their lengths [mm]
};

/// The transform that brings the points `from` onto `to` with the least sum of squared distances. Never a reflection,
/// unless affine. Closed forms (Umeyama 1991, IEEE PAMI 13, 376, in the plane); affine by QR. Throws InputError for too
/// few pairs, points that coincide or lie on one line where that leaves the transform open, or numbers not finite.
PointFit fit_points(const std::vector<PointPair>& pairs, PointFitKind kind);

}  // namespace dwell
