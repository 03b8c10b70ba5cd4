#include "core/tif/line_integrals.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace dwell {

double integral_of_distance(double d, double u0, double u1, double width) {
  if (u0 + u1 < 0.0) {
    std::swap(u0, u1);
    u0 = -u0;
    u1 = -u1;
  }
  const double sum = u0 + u1;
  const double r0 = std::hypot(u0, d), r1 = std::hypot(u1, d), both = r0 + r1;
  if (!(both > 0.0)) return 0.0;
  const double d2 = d * d;
  double asinh_part = 0.0;
  if (d2 > 0.0) {
    // d^2 (asinh(u1/d) - asinh(u0/d)) = d^2 log((u1 + r1) / (u0 + r0))
    const double below = u0 >= 0.0 ? u0 + r0 : d2 / (r0 - u0);
    asinh_part = d2 * std::log1p(width * (1.0 + sum / both) / below);
  }
  return 0.5 * (0.5 * width * (both + sum * sum / both) + asinh_part);
}

double integral_of_gaussian(double sigma, double u0, double u1, double width) {
  // The difference of error functions would cancel here; the error of Gauss-Legendre is 1e-15.
  if (width < 0.1 * sigma) {
    const double middle = 0.5 * (u0 + u1), half = 0.5 * width;
    const auto value = [&](double node) {
      const double u = (middle + half * node) / sigma;
      return std::exp(-0.5 * u * u);
    };
    const double inner = 0.339981043584856264803, outer = 0.861136311594052575224;
    return half * (0.652145154862546142627 * (value(-inner) + value(inner)) +
                   0.347854845137453857373 * (value(-outer) + value(outer)));
  }
  const double scale = 1.0 / (sigma * std::numbers::sqrt2);
  return sigma * std::sqrt(0.5 * std::numbers::pi) * (std::erf(u1 * scale) - std::erf(u0 * scale));
}

}  // namespace dwell
