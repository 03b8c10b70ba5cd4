#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "core/base/point.h"

/// Removal of a disc of radius R that spins about its axis under uniform pressure and runs along a path at constant
/// speed: Lin et al. 2014, "Modeling and analysis of the material removal of three polishing paths", with
/// I = slope / speed. Shares no code with the library.
///
/// Where the printed text does not serve as it stands:
///   eq. 16-18  the limits are those of the radius, s(rho0 -+ R); the disc leaves and enters again between them, and
///              the sum is one of a function with jumps. Here the crossings of the rim are found and each stretch
///              between two of them is integrated.
///   eq. 25, 26 ln(x + sqrt(x^2 + y^2)) cancels for x < 0 and is y^2 ln 0 on the line itself. asinh(x / |y|) differs
///              from it by ln |y|, which drops out of the difference.
///   eq. 28     prints the lower limit twice.
namespace dwell::oracle {

struct Disc {
  double radius;
  double intensity;  // I, slope / speed

  /// Eq. 5 and 7: an infinite line at the distance y.
  double line(double y) const {
    const double a = std::abs(y);
    if (a >= radius) return 0.0;
    const double s = std::sqrt(radius * radius - a * a);
    const double inner = a > 0.0 ? a * a * (std::log(radius + s) - std::log(a)) : 0.0;
    return intensity * (radius * s + inner);
  }

  /// Eq. 8: lines at y = first, first + interval, ...
  double lines(double y, double first, double interval, int count) const {
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += line(y - first - k * interval);
    return sum;
  }

  /// Eq. 25 (26 with the axes exchanged), the antiderivative of sqrt(along^2 + across^2).
  static double antiderivative(double along, double across) {
    const double y = std::abs(across);
    const double log_part = y > 0.0 ? y * y * std::asinh(along / y) : 0.0;
    return 0.5 * (along * std::sqrt(along * along + y * y) + log_part);
  }

  /// Eq. 21, 22 and 27 (23, 24 and 28): a segment along an axis from `from` to `to`, at the distance `across`, of the
  /// point at `at` on that axis.
  double segment(double at, double across, double from, double to) const {
    if (std::abs(across) > radius) return 0.0;
    const double low = std::min(from, to), high = std::max(from, to);
    const double half = std::sqrt(radius * radius - across * across), minus = at - half, plus = at + half;
    std::optional<double> start, end;
    if (low <= minus && minus <= high) start = minus;
    if (!start && minus <= low && low <= plus) start = low;
    if (low <= plus && plus <= high) end = plus;
    if (!end && minus <= high && high <= plus) end = high;
    if (!start || !end) return 0.0;
    return intensity * (antiderivative(*end - at, across) - antiderivative(*start - at, across));
  }

  /// Eq. 29: the sum over the segments of a polyline all of whose segments run along x or y.
  double polyline(Point p, const std::vector<Point>& nodes) const {
    double sum = 0.0;
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      const Point a = nodes[k - 1], b = nodes[k];
      sum += a.y == b.y ? segment(p.x, a.y - p.y, a.x, b.x) : segment(p.y, a.x - p.x, a.y, b.y);
    }
    return sum;
  }
};

/// Integral of a smooth function by 8-point Gauss-Legendre, halved until two halves agree with the whole.
inline double integrate(const std::function<double(double)>& f, double a, double b, double tolerance, int depth = 40) {
  static constexpr double kNode[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  static constexpr double kWeight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  const auto rule = [&](double low, double high) {
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += kWeight[k] * (f(middle - half * kNode[k]) + f(middle + half * kNode[k]));
    return half * sum;
  };
  const double middle = 0.5 * (a + b), halves = rule(a, middle) + rule(middle, b);
  if (depth == 0 || std::abs(halves - rule(a, b)) <= tolerance) return halves;
  return integrate(f, a, middle, 0.5 * tolerance, depth - 1) + integrate(f, middle, b, 0.5 * tolerance, depth - 1);
}

/// The Archimedean spiral rho = interval theta / 2 pi about the origin, 0 <= theta <= last.
struct Spiral {
  double interval;
  double last;

  Point at(double theta) const {
    const double rho = interval * theta / (2.0 * std::numbers::pi);
    return {rho * std::cos(theta), rho * std::sin(theta)};
  }

  /// Eq. 16.
  double arc(double theta) const {
    return interval / (4.0 * std::numbers::pi) * (theta * std::sqrt(1.0 + theta * theta) + std::asinh(theta));
  }

  /// Its inverse, by Newton's method.
  double theta_at(double s) const {
    double theta = std::sqrt(4.0 * std::numbers::pi * s / interval);
    for (int k = 0; k < 50; ++k) {
      const double step = (arc(theta) - s) / speed(theta);
      theta = std::max(theta - step, 0.0);
      if (std::abs(step) < 1e-15 * (1.0 + theta)) break;
    }
    return theta;
  }

  double speed(double theta) const { return interval / (2.0 * std::numbers::pi) * std::sqrt(1.0 + theta * theta); }

  /// Eq. 17 at p: theta in place of s as the variable, cut at every crossing of the rim, to about 1e-10 of I R^2.
  double removal(const Disc& disc, Point p) const {
    const auto gap = [&](double theta) { return distance(at(theta), p) - disc.radius; };
    std::vector<double> cuts{0.0};
    constexpr double kStep = 1e-3;  // a path that dips into the disc for less is missed: 1e-3 rho long, at the rim
    const auto steps = static_cast<long>(std::ceil(last / kStep));
    for (long k = 0; k < steps; ++k) {
      double low = last * static_cast<double>(k) / static_cast<double>(steps);
      double high = last * static_cast<double>(k + 1) / static_cast<double>(steps);
      if ((gap(low) > 0.0) == (gap(high) > 0.0)) continue;
      const bool outside = gap(low) > 0.0;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        ((gap(middle) > 0.0) == outside ? low : high) = middle;
      }
      cuts.push_back(0.5 * (low + high));
    }
    cuts.push_back(last);
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if (gap(0.5 * (cuts[k] + cuts[k + 1])) > 0.0) continue;
      sum += integrate([&](double theta) { return distance(at(theta), p) * speed(theta); }, cuts[k], cuts[k + 1],
                       1e-12 * disc.radius * disc.radius);
    }
    return disc.intensity * sum;
  }
};

/// The Hilbert curve through the centres of 2^order x 2^order square cells of side `cell`, from the lowest left one at
/// `origin`.
inline std::vector<Point> hilbert_nodes(int order, double cell, Point origin) {
  const long side = 1L << order;
  std::vector<Point> nodes;
  for (long d = 0; d < side * side; ++d) {
    long x = 0, y = 0, t = d;
    for (long s = 1; s < side; s *= 2) {
      const long rx = 1 & (t / 2), ry = 1 & (t ^ rx);
      if (ry == 0) {
        if (rx == 1) {
          x = s - 1 - x;
          y = s - 1 - y;
        }
        std::swap(x, y);
      }
      x += s * rx;
      y += s * ry;
      t /= 4;
    }
    nodes.push_back({origin.x + cell * static_cast<double>(x), origin.y + cell * static_cast<double>(y)});
  }
  return nodes;
}

}  // namespace dwell::oracle
