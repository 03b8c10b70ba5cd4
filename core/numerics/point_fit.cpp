#include "core/numerics/point_fit.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/numerics/dense_solve.h"

namespace dwell {
namespace {

PlaneTransform affine(const std::vector<PointPair>& centred) {
  Eigen::MatrixXd from(static_cast<Eigen::Index>(centred.size()), 2), to(from.rows(), 2);
  for (Eigen::Index i = 0; i < from.rows(); ++i) {
    const PointPair& pair = centred[static_cast<std::size_t>(i)];
    from.row(i) << pair.from.x, pair.from.y;
    to.row(i) << pair.to.x, pair.to.y;
  }
  const LeastSquares fit = least_squares(from, to, 1e-9);
  if (fit.rank < 2) throw InputError("the points lie on one line; an affine fit requires three that do not");
  return {fit.x(0, 0), fit.x(1, 0), fit.x(0, 1), fit.x(1, 1), {}};
}

/// Rotation and, with `scaled`, scale that bring `from` onto `to`, both about their centroids.
PlaneTransform fit_rotation(const std::vector<PointPair>& centred, bool scaled) {
  double along = 0.0, across = 0.0, size = 0.0;
  for (const PointPair& p : centred) {
    along += p.from.x * p.to.x + p.from.y * p.to.y;
    across += p.from.x * p.to.y - p.from.y * p.to.x;
    size += p.from.x * p.from.x + p.from.y * p.from.y;
  }
  const double length = std::hypot(along, across);
  if (!(size > 0.0 && length > 0.0)) {
    throw InputError("the points coincide, or leave the rotation open; two that are apart are required");
  }
  const double per = scaled ? 1.0 / size : 1.0 / length;
  return {along * per, -across * per, across * per, along * per, {}};
}

std::size_t pairs_required(PointFitKind kind) {
  if (kind == PointFitKind::Shift) return 1;
  return kind == PointFitKind::Affine ? 3 : 2;
}

}  // namespace

PointFitKind parse_point_fit_kind(const std::string& text) {
  if (text == "shift") return PointFitKind::Shift;
  if (text == "rigid") return PointFitKind::Rigid;
  if (text == "similarity") return PointFitKind::Similarity;
  if (text == "affine") return PointFitKind::Affine;
  throw InputError(fmt::format("fit '{}'; accepted: shift, rigid, similarity or affine", text));
}

PointFit fit_points(const std::vector<PointPair>& pairs, PointFitKind kind) {
  if (pairs.size() < pairs_required(kind)) {
    throw InputError(fmt::format("{} pairs of points; at least {} required", pairs.size(), pairs_required(kind)));
  }
  Point from, to;
  for (const PointPair& p : pairs) {
    if (!std::isfinite(p.from.x + p.from.y + p.to.x + p.to.y)) {
      throw InputError("a point is not finite; finite coordinates are required");
    }
    from = from + p.from, to = to + p.to;
  }
  const double per = 1.0 / static_cast<double>(pairs.size());
  from = per * from, to = per * to;
  std::vector<PointPair> centred;
  centred.reserve(pairs.size());
  for (const PointPair& p : pairs) centred.push_back({p.from - from, p.to - to});
  PointFit fit;
  if (kind == PointFitKind::Affine) fit.transform = affine(centred);
  if (kind == PointFitKind::Rigid || kind == PointFitKind::Similarity) {
    fit.transform = fit_rotation(centred, kind == PointFitKind::Similarity);
  }
  fit.transform.shift = to - fit.transform(from);
  double squares = 0.0;
  for (const PointPair& p : pairs) {
    fit.residuals.push_back(p.to - fit.transform(p.from));
    squares += std::pow(length(fit.residuals.back()), 2);
  }
  fit.rms = std::sqrt(per * squares);
  return fit;
}

}  // namespace dwell
