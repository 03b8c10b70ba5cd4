#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/motion/tool_path.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell::test {

struct Aperture {
  std::string name;
  HeightMap map;
};

/// A disc with two holes and a bay of random sizes, in unequal pitches.
inline HeightMap blob(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  HeightMap map(Grid{19, 27, 0.7, 0.9, {draw(-30.0, 30.0), draw(-30.0, 30.0)}});
  const Point middle = 0.5 * (map.grid.centre(0, 0) + map.grid.centre(18, 26));
  const Point hole = middle + Point{draw(-5.0, 5.0), draw(-3.0, 3.0)};
  const Point slot = middle + Point{draw(-8.0, 8.0), draw(-4.0, 4.0)};
  const double radius = draw(1.0, 3.0), half_width = draw(0.5, 1.5), lobe = draw(0.5, 2.0);
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      const Point p = map.grid.centre(row, col);
      const Point q = p - middle;
      const double rim = 1.0 + 0.15 * lobe * std::cos(3.0 * std::atan2(q.y, q.x));
      const bool in = std::hypot(q.x / 11.5, q.y / 6.0) < rim && distance(p, hole) > radius &&
                      !(std::abs(p.x - slot.x) < half_width && p.y > slot.y);
      if (in) map.at(row, col) = 1.0;
    }
  }
  return map;
}

/// Parts of every sort, on grids of unequal sides and pitches away from the origin.
inline std::vector<Aperture> apertures() {
  std::vector<Aperture> all;
  all.push_back({"rectangle", full_map(13, 21, 0.5, 0.8, {3.0, -17.0})});
  all.push_back({"one pixel", map_from_picture({"....", ".1..", "...."}, 0.6, {-5.0, 2.5})});
  all.push_back({"one row", map_from_picture({"1111111111111"}, 0.7, {12.0, 9.0})});
  all.push_back({"pieces", map_from_picture({"11......11", "11......1.", "..........", "..........", "..........",
                                             "....111...", "....1....."},
                                            1.3, {-2.0, 40.0})});
  HeightMap circle = full_map(23, 31, 0.6, 0.45, {-8.0, 6.0});
  HeightMap annulus = circle;
  for (Index i = 0; i < circle.grid.size(); ++i) {
    const double rho = distance(circle.grid.centre(i), {-1.1, 12.4});
    if (!(rho < 6.3)) circle.values[static_cast<std::size_t>(i)] = kNaN;
    if (!(rho < 6.3 && rho > 3.1)) annulus.values[static_cast<std::size_t>(i)] = kNaN;
  }
  all.push_back({"circle", circle});
  all.push_back({"annulus", annulus});
  for (unsigned seed = 1; seed <= 4; ++seed) all.push_back({"blob " + std::to_string(seed), blob(seed)});
  return all;
}

inline double turn_deg(Point in, Point out) {
  return std::abs(std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y)) * 180.0 / std::numbers::pi;
}

/// Largest angle by which the polyline through the dwell points turns.
inline double sharpest_corner(const ToolPath& path) {
  double sharpest = 0.0;
  for (std::size_t j = 1; j + 1 < path.size(); ++j) {
    if (path.lifted[j] || path.lifted[j + 1]) continue;
    sharpest = std::max(sharpest, turn_deg(path.points[j] - path.points[j - 1], path.points[j + 1] - path.points[j]));
  }
  return sharpest;
}

/// Largest angle by which a moving tool turns, at dwell points and at nodes; halves of strokes of no length are passed
/// over.
inline double sharpest_stroke_corner(const ToolPath& path) {
  const std::vector<Stroke> strokes = moving_strokes(path);
  double sharpest = 0.0;
  Point heading{};
  for (std::size_t j = 0; j < strokes.size(); ++j) {
    if (j == 0 || path.lifted[j]) heading = {};
    for (const Point half : {strokes[j].via - strokes[j].start, strokes[j].finish - strokes[j].via}) {
      if (length(half) < 1e-12) continue;
      if (heading != Point{}) sharpest = std::max(sharpest, turn_deg(heading, half));
      heading = half;
    }
  }
  return sharpest;
}

inline double distance_to_segment(Point p, Point a, Point b) {
  const Point ab = b - a, ap = p - a;
  const double squared = ab.x * ab.x + ab.y * ab.y;
  const double t = squared > 0.0 ? std::clamp((ap.x * ab.x + ap.y * ab.y) / squared, 0.0, 1.0) : 0.0;
  return distance(p, a + t * ab);
}

/// Distance from p to where the moving tool goes, looking at every stroke.
inline double distance_to_strokes(const std::vector<Stroke>& strokes, Point p) {
  double best = kInf;
  for (const Stroke& s : strokes) {
    best = std::min({best, distance_to_segment(p, s.start, s.via), distance_to_segment(p, s.via, s.finish)});
  }
  return best;
}

inline double longest_move_on_part(const ToolPath& path) {
  double longest = 0.0;
  for (std::size_t j = 1; j < path.size(); ++j) {
    if (!path.lifted[j]) longest = std::max(longest, distance(path.points[j - 1], path.points[j]));
  }
  return longest;
}

inline bool same_bytes(const ToolPath& a, const ToolPath& b) {
  return a.points.size() == b.points.size() && a.lifted == b.lifted &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Point)) == 0;
}

/// Whether b is a run backwards.
inline bool reversed(const ToolPath& a, const ToolPath& b) {
  const std::size_t n = a.size();
  if (b.size() != n || n == 0 || !b.lifted[0]) return false;
  for (std::size_t j = 0; j < n; ++j) {
    if (a.points[j] != b.points[n - 1 - j]) return false;
    if (j > 0 && a.lifted[j] != b.lifted[n - j]) return false;
  }
  return true;
}

}  // namespace dwell::test
