#include "core/motion/stroke_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dwell {
namespace {

constexpr std::array<double, 4> kNodes = {-0.861136311594052575224, -0.339981043584856264803, 0.339981043584856264803,
                                          0.861136311594052575224};
constexpr std::array<double, 4> kWeights = {0.347854845137453857373, 0.652145154862546142627, 0.652145154862546142627,
                                            0.347854845137453857373};

/// Appends the parameters in (0, 1) where a coordinate running from u0 to u1 (in pixels) passes a whole number.
void append_crossings(double u0, double u1, std::vector<double>& cuts) {
  const double low = std::min(u0, u1), high = std::max(u0, u1);
  if (!(high > low)) return;
  for (double k = std::floor(low) + 1.0; k < high; k += 1.0) cuts.push_back((k - u0) / (u1 - u0));
}

void append_piece(Point a, Point b, double share, const Grid& grid, std::vector<double>& cuts,
                  std::vector<QuadraturePoint>& points) {
  cuts.assign({0.0, 1.0});
  append_crossings((a.x - grid.origin.x) / grid.pitch_x, (b.x - grid.origin.x) / grid.pitch_x, cuts);
  append_crossings((a.y - grid.origin.y) / grid.pitch_y, (b.y - grid.origin.y) / grid.pitch_y, cuts);
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

void append_stroke_quadrature(const Stroke& stroke, const Grid& grid, std::vector<QuadraturePoint>& points) {
  const double first = distance(stroke.start, stroke.via), second = distance(stroke.via, stroke.finish);
  const double total = first + second;
  if (!(total > 0.0)) {
    points.push_back({stroke.via, 1.0});
    return;
  }
  thread_local std::vector<double> cuts;  // kept from call to call, because millions of strokes would allocate it anew
  if (first > 0.0) append_piece(stroke.start, stroke.via, first / total, grid, cuts, points);
  if (second > 0.0) append_piece(stroke.via, stroke.finish, second / total, grid, cuts, points);
}

}  // namespace dwell
