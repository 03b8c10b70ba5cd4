#include "core/tif/pixel_mean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/numerics/spline_surface.h"
#include "core/tif/line_integrals.h"

namespace dwell {
namespace {

/// Integral of a function of r over the line from (x0, y) to (x1, y).
using LineIntegral = std::function<double(double x0, double x1, double y)>;

/// Where, between y0 and y1, the circle of this radius begins and ends, and crosses the lines x0 and x1: between two of
/// these the integral along the line is smooth in y. So it is on either side of the axis.
std::vector<double> smooth_pieces(double radius, double x0, double x1, double y0, double y1) {
  std::vector<double> cuts{std::max(y0, -radius), std::min(y1, radius)};
  if (!(cuts[0] < cuts[1])) return {};
  const double low = cuts[0], high = cuts[1];
  const auto cut = [&](double y) {
    if (y > low && y < high) cuts.push_back(y);
  };
  cut(0.0);
  for (const double x : {x0, x1}) {
    if (!(std::abs(x) < radius)) continue;
    const double y = std::sqrt((radius - x) * (radius + x));
    cut(y);
    cut(-y);
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

/// The mean over a pixel about `centre` of a function of r that ends at `radius`.
double mean_within_circle(const LineIntegral& along_x, double radius, Point centre, double hx, double hy) {
  constexpr std::array<double, 4> kNodes{0.183434642495649805, 0.525532409916328986, 0.796666477413626740,
                                         0.960289856497536232};
  constexpr std::array<double, 4> kWeights{0.362683783378361983, 0.313706645877887287, 0.222381034453374471,
                                           0.101228536290376259};
  const double x0 = centre.x - 0.5 * hx, x1 = centre.x + 0.5 * hx;
  const std::vector<double> cuts = smooth_pieces(radius, x0, x1, centre.y - 0.5 * hy, centre.y + 0.5 * hy);
  const auto line = [&](double y) {
    const double chord = std::sqrt(std::max(0.0, (radius - y) * (radius + y)));
    const double from = std::max(x0, -chord), to = std::min(x1, chord);
    return from < to ? along_x(from, to, y) : 0.0;
  };
  double sum = 0.0;
  for (std::size_t k = 1; k < cuts.size(); ++k) {
    const double middle = 0.5 * (cuts[k] + cuts[k - 1]), half = 0.5 * (cuts[k] - cuts[k - 1]);
    for (std::size_t i = 0; i < kNodes.size(); ++i)
      sum += half * kWeights[i] * (line(middle - half * kNodes[i]) + line(middle + half * kNodes[i]));
  }
  return sum / (hx * hy);
}

std::function<double(Point)> mean_of_disc(const RemovalFunction& tif, double hx, double hy) {
  return [slope = tif.slope, radius = tif.radius, hx, hy](Point p) {
    const LineIntegral along_x = [](double x0, double x1, double y) {
      return integral_of_distance(std::abs(y), x0, x1, x1 - x0);
    };
    return slope * mean_within_circle(along_x, radius, p, hx, hy);
  };
}

std::function<double(Point)> mean_of_gaussian(const RemovalFunction& tif, double hx, double hy) {
  return [peak = tif.peak, sigma = tif.sigma, radius = tif.radius, hx, hy](Point p) {
    const double far = std::hypot(std::abs(p.x) + 0.5 * hx, std::abs(p.y) + 0.5 * hy);
    if (far <= radius) {
      return peak / (hx * hy) * integral_of_gaussian(sigma, p.x - 0.5 * hx, p.x + 0.5 * hx, hx) *
             integral_of_gaussian(sigma, p.y - 0.5 * hy, p.y + 0.5 * hy, hy);
    }
    const LineIntegral along_x = [sigma](double x0, double x1, double y) {
      return std::exp(-0.5 * y * y / (sigma * sigma)) * integral_of_gaussian(sigma, x0, x1, x1 - x0);
    };
    return peak * mean_within_circle(along_x, radius, p, hx, hy);
  };
}

/// Integral of the cubic B-spline about 0 from minus infinity to u.
double bspline_integral(double u) {
  const double t = std::clamp(u + 2.0, 0.0, 4.0);
  constexpr std::array<double, 4> kSigns{1.0, -4.0, 6.0, -4.0};
  double sum = 0.0;
  for (std::size_t k = 0; k < kSigns.size(); ++k) {
    const double s = std::max(0.0, t - static_cast<double>(k));
    sum += kSigns[k] * s * s * s * s;
  }
  return sum / 24.0;
}

/// Along one axis of a spline: its first coefficient under an interval, and the share of the interval's mean that each
/// from there on has.
struct IntervalShares {
  Index first = 0;
  std::vector<double> shares;

  void set(double from, double to, double origin, double pitch, Index count) {
    const double u0 = (from - origin) / pitch, u1 = (to - origin) / pitch;
    first =
        std::max<Index>(0, static_cast<Index>(std::floor(std::clamp(u0, -4.0, static_cast<double>(count) + 4.0))) - 1);
    const Index last =
        std::min(count - 1, static_cast<Index>(std::ceil(std::clamp(u1, -4.0, static_cast<double>(count) + 4.0))) + 1);
    shares.clear();
    for (Index k = first; k <= last; ++k) {
      const auto at = static_cast<double>(k);
      shares.push_back((bspline_integral(u1 - at) - bspline_integral(u0 - at)) / (u1 - u0));
    }
  }
};

std::function<double(Point)> mean_of_samples(const RemovalFunction& tif, double hx, double hy) {
  const auto spline = std::make_shared<const SplineSurface>(tif.samples.grid, tif.samples.values);
  return [spline, hx, hy, x = IntervalShares{}, y = IntervalShares{}](Point p) mutable {
    const Grid& g = spline->grid();
    x.set(p.x - 0.5 * hx, p.x + 0.5 * hx, g.origin.x, g.pitch_x, g.cols);
    y.set(p.y - 0.5 * hy, p.y + 0.5 * hy, g.origin.y, g.pitch_y, g.rows);
    double sum = 0.0;
    for (std::size_t i = 0; i < y.shares.size(); ++i) {
      const double* c = spline->coefficients().data() + g.index(y.first + static_cast<Index>(i), x.first);
      double line = 0.0;
      for (std::size_t j = 0; j < x.shares.size(); ++j) line += x.shares[j] * c[j];
      sum += y.shares[i] * line;
    }
    return sum;
  };
}

}  // namespace

std::function<double(Point)> mean_rate_over_pixel(const RemovalFunction& tif, double hx, double hy) {
  switch (tif.kind) {
    case RemovalFunction::Kind::Gaussian:
      return mean_of_gaussian(tif, hx, hy);
    case RemovalFunction::Kind::Disc:
      return mean_of_disc(tif, hx, hy);
    case RemovalFunction::Kind::Measured:
    case RemovalFunction::Kind::Model:
      break;
  }
  return mean_of_samples(tif, hx, hy);
}

std::function<double(Point)> rate_at_point(const RemovalFunction& tif) {
  const double square = tif.radius * tif.radius;
  switch (tif.kind) {
    case RemovalFunction::Kind::Gaussian:
      return [square, peak = tif.peak, factor = -0.5 / (tif.sigma * tif.sigma)](Point p) {
        const double r2 = p.x * p.x + p.y * p.y;
        return r2 <= square ? peak * std::exp(factor * r2) : 0.0;
      };
    case RemovalFunction::Kind::Disc:
      return [square, slope = tif.slope](Point p) {
        const double r2 = p.x * p.x + p.y * p.y;
        return r2 <= square ? slope * std::sqrt(r2) : 0.0;
      };
    case RemovalFunction::Kind::Measured:
    case RemovalFunction::Kind::Model:
      break;
  }
  return SplineSurface(tif.samples.grid, tif.samples.values);
}

}  // namespace dwell
