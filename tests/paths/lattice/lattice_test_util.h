#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/motion/tool_path.h"
#include "paths/lattice/cell_lattice.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell::test {

using RowCol = std::pair<long, long>;

/// The lattice as its documentation says it, every point against every pixel.
struct SlowLattice {
  double pitch, cosine, sine, middle_u, middle_v;
  long rows, cols;
  double reach;
  std::set<RowCol> kept;

  SlowLattice(const HeightMap& map, const LatticeOptions& o) : pitch(o.pitch) {
    cosine = std::cos(o.angle_deg * std::numbers::pi / 180.0);
    sine = std::sin(o.angle_deg * std::numbers::pi / 180.0);
    const double overrun = o.overrun.value_or(0.0);
    double low_u = kInf, high_u = -kInf, low_v = kInf, high_v = -kInf;
    for (Index i = 0; i < map.grid.size(); ++i) {
      if (!std::isfinite(map.values[static_cast<std::size_t>(i)])) continue;
      const Point p = map.grid.centre(i);
      low_u = std::min(low_u, cosine * p.x + sine * p.y);
      high_u = std::max(high_u, cosine * p.x + sine * p.y);
      low_v = std::min(low_v, cosine * p.y - sine * p.x);
      high_v = std::max(high_v, cosine * p.y - sine * p.x);
    }
    middle_u = (low_u + high_u) / 2;
    middle_v = (low_v + high_v) / 2;
    cols = static_cast<long>(std::floor((high_u - low_u + 2 * overrun) / pitch + 1e-9)) + 1;
    rows = static_cast<long>(std::floor((high_v - low_v + 2 * overrun) / pitch + 1e-9)) + 1;
    reach = std::max({overrun, pitch / std::sqrt(2.0), std::hypot(map.grid.pitch_x, map.grid.pitch_y) / 2});
    for (long row = 0; row < rows; ++row) {
      for (long col = 0; col < cols; ++col) {
        if (brute_force_distance(map, at({row, col})) <= reach + 1e-9 * pitch) kept.insert({row, col});
      }
    }
  }

  Point at(RowCol c) const {
    const double u = middle_u + pitch * (static_cast<double>(c.second) - static_cast<double>(cols - 1) / 2);
    const double v = middle_v + pitch * (static_cast<double>(c.first) - static_cast<double>(rows - 1) / 2);
    return {cosine * u - sine * v, sine * u + cosine * v};
  }

  /// The lattice point that a path point is; fails the test if it is none.
  RowCol cell(Point p) const {
    const double u = (cosine * p.x + sine * p.y - middle_u) / pitch + static_cast<double>(cols - 1) / 2;
    const double v = (cosine * p.y - sine * p.x - middle_v) / pitch + static_cast<double>(rows - 1) / 2;
    const RowCol c{std::lround(v), std::lround(u)};
    EXPECT_LE(distance(at(c), p), 1e-9 * (pitch + length(p)));
    return c;
  }
};

inline bool neighbours(RowCol a, RowCol b) { return std::abs(a.first - b.first) + std::abs(a.second - b.second) == 1; }

/// Lattice points of a path in order; fails the test if one is not kept or comes twice.
inline std::vector<RowCol> visited_once(const ToolPath& path, const SlowLattice& lattice) {
  std::vector<RowCol> order;
  std::set<RowCol> seen;
  EXPECT_EQ(path.lifted.size(), path.points.size());
  for (const Point p : path.points) {
    const RowCol c = lattice.cell(p);
    EXPECT_EQ(lattice.kept.count(c), 1u) << "row " << c.first << " col " << c.second;
    EXPECT_TRUE(seen.insert(c).second) << "twice: row " << c.first << " col " << c.second;
    order.push_back(c);
  }
  return order;
}

/// Rectangles, ellipses, rings, blobs with holes, speckles, one pixel, one row, two pieces; by number.
inline HeightMap random_aperture(unsigned number) {
  std::mt19937 random(number);
  const auto from = [&](int low, int high) { return low + static_cast<int>(random() % (high - low + 1u)); };
  const int kind = static_cast<int>(number % 8);
  Grid grid;
  grid.rows = kind == 5 || kind == 6 ? 1 : from(4, 28);
  grid.cols = kind == 5 ? 1 : from(4, 33);
  grid.pitch_x = 0.5 + 0.1 * from(0, 9);
  grid.pitch_y = 0.5 + 0.1 * from(0, 9);
  grid.origin = {-7.25 + from(0, 30), 3.5 - from(0, 30)};
  HeightMap map(grid);
  std::vector<std::array<double, 3>> blobs;
  for (int k = 0; k < 6; ++k) {
    blobs.push_back(
        {1.0 * from(0, static_cast<int>(grid.rows)), 1.0 * from(0, static_cast<int>(grid.cols)), 1.0 * from(2, 7)});
  }
  for (Index row = 0; row < grid.rows; ++row) {
    for (Index col = 0; col < grid.cols; ++col) {
      const double r = (2.0 * static_cast<double>(row) + 1.0) / static_cast<double>(grid.rows) - 1.0;
      const double c = (2.0 * static_cast<double>(col) + 1.0) / static_cast<double>(grid.cols) - 1.0;
      bool in = true;
      if (kind == 1) in = r * r + c * c <= 1.0;
      if (kind == 2) in = r * r + c * c <= 1.0 && r * r + c * c >= 0.2;
      if (kind == 3) {
        in = false;
        for (std::size_t k = 0; k < blobs.size(); ++k) {
          const auto& [y, x, radius] = blobs[k];
          if (std::hypot(static_cast<double>(row) - y, static_cast<double>(col) - x) <= radius) in = k < 4;
        }
      }
      if (kind == 4) in = random() % 10 < 7;
      if (kind == 7) in = std::abs(c) > 0.4;
      if (in) map.at(row, col) = 1.0 + 0.01 * static_cast<double>(random() % 100);
    }
  }
  if (map.valid_pixels() == 0) map.at(0, 0) = 1.0;
  return map;
}

}  // namespace dwell::test
