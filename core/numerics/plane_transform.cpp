#include "core/numerics/plane_transform.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.h"

namespace dwell {

PlaneTransform PlaneTransform::inverse() const {
  const double det = determinant();
  if (!(std::isfinite(1.0 / det) && det != 0.0)) {
    throw InputError(fmt::format("transform with determinant {}; one that can be inverted is required", det));
  }
  PlaneTransform result{yy / det, -xy / det, -yx / det, xx / det, {}};
  result.shift = Point{} - result(shift);
  return result;
}

PlaneTransform composed(const PlaneTransform& second, const PlaneTransform& first) {
  return {second.xx * first.xx + second.xy * first.yx, second.xx * first.xy + second.xy * first.yy,
          second.yx * first.xx + second.yy * first.yx, second.yx * first.xy + second.yy * first.yy,
          second(first.shift)};
}

PlaneTransform similarity(Point centre, Point displacement, double degrees, double scale) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  PlaneTransform result{c, -s, s, c, {}};
  result.shift = centre + displacement - result(centre);
  return result;
}

}  // namespace dwell
