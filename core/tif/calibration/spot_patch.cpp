#include "core/tif/calibration/spot_patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/map/robust_plane.h"

namespace dwell {
namespace {

constexpr double kRing = 1.6;  // outer radius of the surroundings, in radii
constexpr double kMostMissing = 0.05;
constexpr Index kMargin = 4;  // pixels kept beyond the radius, for the spline
constexpr Index kLeastPixels = 12;
constexpr std::size_t kLeastRing = 30;

std::string place(Point p) { return fmt::format("spot at ({:.4g}, {:.4g}) mm", p.x, p.y); }

std::vector<Index> ring_about(const HeightMap& depth, Point centre, double radius, const std::vector<Point>& others) {
  std::vector<Index> ring;
  const Grid& g = depth.grid;
  for (Index i = 0; i < g.size(); ++i) {
    if (!std::isfinite(depth.values[static_cast<std::size_t>(i)])) continue;
    const Point p = g.centre(i);
    const double r = distance(p, centre);
    if (r < radius || r > kRing * radius) continue;
    if (std::any_of(others.begin(), others.end(), [&](Point o) { return distance(p, o) < radius; })) continue;
    ring.push_back(i);
  }
  return ring;
}

/// How many of the eight directions the ring covers.
int octants(const HeightMap& depth, const std::vector<Index>& ring, Point centre) {
  std::array<int, 8> count{};
  for (const Index i : ring) {
    const Point d = depth.grid.centre(i) - centre;
    const double turn = std::atan2(d.y, d.x) / (2.0 * std::numbers::pi) + 0.5;
    ++count[std::min<std::size_t>(static_cast<std::size_t>(8.0 * turn), 7)];
  }
  return static_cast<int>(std::count_if(count.begin(), count.end(), [](int n) { return n >= 2; }));
}

Plane surroundings(const HeightMap& depth, Point centre, double radius, const std::vector<Point>& others,
                   SpotBaseline baseline) {
  const std::vector<Index> ring = ring_about(depth, centre, radius, others);
  const int needed = baseline == SpotBaseline::Plane ? 5 : 1;
  const bool enough = ring.size() >= kLeastRing && octants(depth, ring, centre) >= needed;
  if (enough) {
    Plane plane = robust_plane(depth, ring, baseline == SpotBaseline::Plane);
    if (baseline == SpotBaseline::None) plane.level = 0.0;
    return plane;
  }
  if (baseline == SpotBaseline::None) return {};
  throw InputError(fmt::format(
      "{}: {} with data lie around it from {:.4g} to {:.4g} mm, in {} of 8 directions; the baseline needs {} in "
      "{} (another `radius`, or `baseline` {})",
      place(centre), counted(ring.size(), "pixel"), radius, kRing * radius, octants(depth, ring, centre), kLeastRing,
      needed, baseline == SpotBaseline::Plane ? "constant or none" : "none"));
}

/// Pixels without data take the mean of their neighbours with data, ring by ring from the rim of the hole. Off the map,
/// all is zero.
void fill_holes(SpotPatch& patch) {
  const Grid& g = patch.depth.grid;
  std::vector<char> open = patch.filled;
  for (bool any = true; any;) {
    any = false;
    const std::vector<char> before = open;
    for (Index r = 0; r < g.rows; ++r) {
      for (Index c = 0; c < g.cols; ++c) {
        if (!before[static_cast<std::size_t>(g.index(r, c))]) continue;
        double sum = 0.0;
        int count = 0;
        for (Index i = std::max<Index>(r - 1, 0); i <= std::min(r + 1, g.rows - 1); ++i) {
          for (Index j = std::max<Index>(c - 1, 0); j <= std::min(c + 1, g.cols - 1); ++j) {
            if (before[static_cast<std::size_t>(g.index(i, j))]) continue;
            sum += patch.depth.at(i, j);
            ++count;
          }
        }
        if (count == 0) continue;
        patch.depth.at(r, c) = sum / count;
        open[static_cast<std::size_t>(g.index(r, c))] = 0;
        any = true;
      }
    }
  }
}

void refuse_missing(const SpotPatch& patch, Point centre, double radius) {
  const Grid& g = patch.depth.grid;
  Index inside = 0;
  for (Index i = 0; i < g.size(); ++i) inside += distance(g.centre(i), centre) <= radius;
  if (inside < kLeastPixels) {
    throw InputError(fmt::format("{}: {} lie within the radius of {:.4g} mm; at least {} are required", place(centre),
                                 counted(inside, "pixel"), radius, kLeastPixels));
  }
  const double missing = static_cast<double>(patch.filled_inside) / static_cast<double>(inside);
  if (missing > kMostMissing) {
    throw InputError(
        fmt::format("{}: {:.0f} % of the pixels within its radius of {:.4g} mm have no data or lie off the "
                    "map; at most {:.0f} % are accepted (`radius` says how far a spot reaches)",
                    place(centre), 100.0 * missing, radius, 100.0 * kMostMissing));
  }
}

}  // namespace

SpotPatch cut_spot(const HeightMap& depth, Point centre, double radius, const std::vector<Point>& others,
                   SpotBaseline baseline) {
  const Grid& g = depth.grid;
  const auto nearest = [](double at, double origin, double pitch) { return std::lround((at - origin) / pitch); };
  const Index row = nearest(centre.y, g.origin.y, g.pitch_y), col = nearest(centre.x, g.origin.x, g.pitch_x);
  const Index half_rows = static_cast<Index>(std::ceil(radius / g.pitch_y)) + kMargin,
              half_cols = static_cast<Index>(std::ceil(radius / g.pitch_x)) + kMargin;
  if (half_rows > 2 * g.rows + 16 || half_cols > 2 * g.cols + 16) {
    throw InputError(
        "radius", fmt::format("{:.4g} mm", radius), "no more than the map's own size",
        fmt::format("`radius` = {:.4g} mm; the map is only {:.4g} x {:.4g} mm", radius, g.width(), g.height()));
  }
  const Plane plane = surroundings(depth, centre, radius, others, baseline);
  SpotPatch patch;
  patch.centre = centre;
  patch.scatter = plane.scatter;
  patch.depth = HeightMap(
      Grid{2 * half_rows + 1, 2 * half_cols + 1, g.pitch_x, g.pitch_y, {g.x(col - half_cols), g.y(row - half_rows)}});
  patch.filled.assign(patch.depth.values.size(), 0);
  for (Index i = 0; i < patch.depth.grid.size(); ++i) {
    const Index r = row - half_rows + i / patch.depth.grid.cols, c = col - half_cols + i % patch.depth.grid.cols;
    const bool on_map = r >= 0 && c >= 0 && r < g.rows && c < g.cols;
    const bool known = on_map && std::isfinite(depth.at(r, c));
    const Point p = patch.depth.grid.centre(i);
    const bool inside = distance(p, centre) <= radius;
    double& value = patch.depth.values[static_cast<std::size_t>(i)];
    value = known ? depth.at(r, c) - plane.at(p) : 0.0;
    patch.filled[static_cast<std::size_t>(i)] = !known && (on_map || inside);
    patch.filled_inside += !known && inside;
  }
  refuse_missing(patch, centre, radius);
  fill_holes(patch);
  patch.surface = SplineSurface(patch.depth.grid, patch.depth.values);
  return patch;
}

Point spot_centroid(const SpotPatch& patch, Point start, double radius, double share) {
  const Grid& g = patch.depth.grid;
  double peak = 0.0;
  for (Index i = 0; i < g.size(); ++i) {
    if (distance(g.centre(i), start) <= radius) peak = std::max(peak, patch.depth.values[static_cast<std::size_t>(i)]);
  }
  Point at = start;
  for (int pass = 0; pass < 20; ++pass) {
    double sum = 0.0;
    Point moment;
    for (Index i = 0; i < g.size(); ++i) {
      const Point p = g.centre(i);
      const double v = patch.depth.values[static_cast<std::size_t>(i)] - share * peak;
      if (v <= 0.0 || distance(p, at) > radius) continue;
      sum += v;
      moment = moment + v * p;
    }
    if (!(sum > 0.0)) return at;
    const Point next = (1.0 / sum) * moment;
    const double step = distance(next, at);
    at = next;
    if (step < 1e-9 * radius) break;
  }
  return at;
}

}  // namespace dwell
