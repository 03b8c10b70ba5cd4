#include "core/anatomy/edge_zone.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/map/edge_distance.h"

namespace dwell {
namespace {

/// Pixels without data that touch each other by their sides.
struct Hole {
  std::vector<Index> pixels;
  Index top, bottom, left, right;
};

Hole hole_at(const HeightMap& map, Index first, std::vector<unsigned char>& seen) {
  const Index cols = map.grid.cols, rows = map.grid.rows;
  Hole hole{{first}, first / cols, first / cols, first % cols, first % cols};
  seen[static_cast<std::size_t>(first)] = 1;
  for (std::size_t k = 0; k < hole.pixels.size(); ++k) {
    const Index pixel = hole.pixels[k], row = pixel / cols, col = pixel % cols;
    hole.top = std::min(hole.top, row), hole.bottom = std::max(hole.bottom, row);
    hole.left = std::min(hole.left, col), hole.right = std::max(hole.right, col);
    const auto visit = [&](Index next) {
      const auto i = static_cast<std::size_t>(next);
      if (seen[i] != 0 || std::isfinite(map.values[i])) return;
      seen[i] = 1;
      hole.pixels.push_back(next);
    };
    if (row > 0) visit(pixel - cols);
    if (row + 1 < rows) visit(pixel + cols);
    if (col > 0) visit(pixel - 1);
    if (col + 1 < cols) visit(pixel + 1);
  }
  return hole;
}

/// The map with heights, whatever they are, in holes that are narrower than `widest` and do not reach its edge.
HeightMap without_narrow_holes(HeightMap map, double widest) {
  const Grid& g = map.grid;
  std::vector<unsigned char> seen(map.values.size(), 0);
  for (Index i = 0; i < g.size(); ++i) {
    if (seen[static_cast<std::size_t>(i)] != 0 || std::isfinite(map.values[static_cast<std::size_t>(i)])) continue;
    const Hole hole = hole_at(map, i, seen);
    if (hole.top == 0 || hole.left == 0 || hole.bottom == g.rows - 1 || hole.right == g.cols - 1) continue;
    const double width = std::min(g.pitch_x * static_cast<double>(hole.right - hole.left + 1),
                                  g.pitch_y * static_cast<double>(hole.bottom - hole.top + 1));
    if (width >= widest) continue;
    for (const Index k : hole.pixels) map.values[static_cast<std::size_t>(k)] = 0.0;
  }
  return map;
}

/// Distances as edge_distances has them, but along the line alone of a map that is one row or one column of pixels:
/// such a map is a line over a part, and beside it lies what was not measured.
std::vector<double> distances_on_line(const HeightMap& map) {
  const double pitch = map.grid.rows == 1 ? map.grid.pitch_x : map.grid.pitch_y;
  std::vector<double> distance(map.values.size(), 0.0);
  double since = 0.0;
  for (std::size_t i = 0; i < distance.size(); ++i)
    distance[i] = since = std::isfinite(map.values[i]) ? since + pitch : 0.0;
  since = 0.0;
  for (std::size_t i = distance.size(); i-- > 0;) {
    since = std::isfinite(map.values[i]) ? since + pitch : 0.0;
    distance[i] = std::min(distance[i], since);
  }
  return distance;
}

}  // namespace

EdgeZone edge_zone(const HeightMap& map, double fwhm, int threads) {
  EdgeZone zone;
  zone.width = kEdgeZoneInFwhm * fwhm;
  zone.holds.assign(map.values.size(), 0);
  const Grid& g = map.grid;
  const bool whole = map.valid_pixels() == g.size(), line = std::min(g.rows, g.cols) == 1 && g.size() > 1;
  const std::vector<double> distance =
      line ? distances_on_line(map) : edge_distances(whole ? map : without_narrow_holes(map, fwhm), threads);
  // From a centre to the pixel's side.
  const double half = 0.5 * (!line ? std::min(g.pitch_x, g.pitch_y) : g.rows == 1 ? g.pitch_x : g.pitch_y);
  for (std::size_t i = 0; i < map.values.size(); ++i)
    zone.holds[i] = std::isfinite(map.values[i]) && distance[i] - half <= zone.width ? 1 : 0;
  zone.pixels = std::accumulate(zone.holds.begin(), zone.holds.end(), Index{0});
  return zone;
}

}  // namespace dwell
