#include "core/motion/stroke_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dwell {
namespace {

constexpr std::array<double, 4> kNodes = {-0.861136311594052575224, -0.339981043584856264803, 0.339981043584856264803,
                                          0.861136311594052575224};
constexpr std::array<double, 4> kWeights = {0.347854845137453857373, 0.652145154862546142627, 0.652145154862546142627,
                                            0.347854845137453857373};

/// A straight line in pitches of the lattice, over the parameter t from 0 to 1.
struct LatticeLine {
  double u0, u1, v0, v1;

  // At the ends exactly these numbers.
  double u(double t) const { return t == 1.0 ? u1 : u0 + t * (u1 - u0); }
  double v(double t) const { return t == 1.0 ? v1 : v0 + t * (v1 - v0); }
};

/// Parameters from `first` to `last`; none if first > last.
struct Span {
  double first = 0.0, last = 1.0;

  /// Keeps those at which a coordinate that runs from c0 to c1 is between low and high.
  void clip(double c0, double c1, double low, double high) {
    if (c0 >= low && c0 <= high && c1 >= low && c1 <= high) return;
    if (!(std::abs(c1 - c0) > 0.0)) {
      last = -1.0;
      return;
    }
    const double a = (low - c0) / (c1 - c0), b = (high - c0) / (c1 - c0);
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
};

/// Appends the parameters in (0, 1) at which a coordinate that runs from c0 to c1 passes a whole number between c_first
/// and c_last.
void append_crossings(double c0, double c1, double c_first, double c_last, std::vector<double>& cuts) {
  const double low = std::min(c_first, c_last), high = std::max(c_first, c_last);
  if (!(high > low)) return;
  for (double k = std::floor(low) + 1.0; k < high; k += 1.0) cuts.push_back((k - c0) / (c1 - c0));
}

void append_piece(Point a, Point b, double share, const Grid& grid, const LatticeBox& reach, std::vector<double>& cuts,
                  std::vector<QuadraturePoint>& points) {
  const LatticeLine line{(a.x - grid.origin.x) / grid.pitch_x, (b.x - grid.origin.x) / grid.pitch_x,
                         (a.y - grid.origin.y) / grid.pitch_y, (b.y - grid.origin.y) / grid.pitch_y};
  Span inside;
  inside.clip(line.u0, line.u1, reach.low_u, reach.high_u);
  inside.clip(line.v0, line.v1, reach.low_v, reach.high_v);
  if (!(inside.first < inside.last)) return;
  cuts.assign({inside.first, inside.last});
  append_crossings(line.u0, line.u1, line.u(inside.first), line.u(inside.last), cuts);
  append_crossings(line.v0, line.v1, line.v(inside.first), line.v(inside.last), cuts);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double half = 0.5 * (cuts[k + 1] - cuts[k]), middle = 0.5 * (cuts[k + 1] + cuts[k]);
    if (!(half > 0.0)) continue;
    for (std::size_t q = 0; q < 4; ++q) {
      points.push_back({a + (middle + half * kNodes[q]) * (b - a), share * half * kWeights[q]});
    }
  }
}

}  // namespace

void append_stroke_quadrature(const Stroke& stroke, const Grid& grid, const LatticeBox& reach,
                              std::vector<QuadraturePoint>& points) {
  const double first = distance(stroke.start, stroke.via), second = distance(stroke.via, stroke.finish);
  const double total = first + second;
  if (!(total > 0.0)) {
    const double u = (stroke.via.x - grid.origin.x) / grid.pitch_x, v = (stroke.via.y - grid.origin.y) / grid.pitch_y;
    if (reach.holds(u, v)) points.push_back({stroke.via, 1.0});
    return;
  }
  thread_local std::vector<double> cuts;  // kept from call to call, because millions of strokes would allocate it anew
  if (first > 0.0) append_piece(stroke.start, stroke.via, first / total, grid, reach, cuts, points);
  if (second > 0.0) append_piece(stroke.via, stroke.finish, second / total, grid, reach, cuts, points);
}

void append_stroke_quadrature(const Stroke& stroke, const Grid& grid, std::vector<QuadraturePoint>& points) {
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  append_stroke_quadrature(stroke, grid, {-kNoEnd, kNoEnd, -kNoEnd, kNoEnd}, points);
}

}  // namespace dwell
