/// Paths that keep the tool's axis out of zones while it is down.

#include "paths/domain/keep_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/errors.h"

namespace dwell {
namespace {

/// Whether a place lies in an area, by formulas of their own.
bool lies_in(const std::string& kind, Point p) {
  if (kind == "rect:-2,-1,3,2") return p.x >= -2.0 && p.x <= 3.0 && p.y >= -1.0 && p.y <= 2.0;
  if (kind == "circle:1,-0.5,2") return std::hypot(p.x - 1.0, p.y + 0.5) <= 2.0;
  if (kind == "ellipse:0.5,0.5,3,1,90") return std::hypot((p.x - 0.5) / 1.0, (p.y - 0.5) / 3.0) <= 1.0;
  if (kind == "annulus:0,1,1.5,3") return std::hypot(p.x, p.y - 1.0) >= 1.5 && std::hypot(p.x, p.y - 1.0) <= 3.0;
  // polygon:-3,-3,4,-3,-3,4/-2,-2,0,-2,-2,0: a triangle with a triangular hole
  const bool outer = p.x >= -3.0 && p.y >= -3.0 && p.x + p.y <= 1.0;
  const bool hole = p.x > -2.0 && p.y > -2.0 && p.x + p.y < -2.0;
  return outer && !hole;
}

TEST(KeepOut, SeesAMoveThatComesIntoAnArea) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-5.0, 5.0);
  for (const std::string kind : {"rect:-2,-1,3,2", "circle:1,-0.5,2", "ellipse:0.5,0.5,3,1,90", "annulus:0,1,1.5,3",
                                 "polygon:-3,-3,4,-3,-3,4/-2,-2,0,-2,-2,0"}) {
    const Aperture area = parse_aperture(kind);
    int crossing = 0, beside = 0;
    for (int k = 0; k < 2000; ++k) {
      const Point a{place(random), place(random)}, b{place(random), place(random)};
      bool inside = false;
      for (int i = 0; i <= 4000 && !inside; ++i) inside = lies_in(kind, a + (i / 4000.0) * (b - a));
      if (inside) {
        EXPECT_TRUE(enters(area, a, b)) << kind << ' ' << a.x << ',' << a.y << ' ' << b.x << ',' << b.y;
        ++crossing;
        continue;
      }
      // What passes closer than the samples can see is left out of the comparison.
      bool near = false;
      for (int i = 0; i <= 400 && !near; ++i) {
        const Point p = a + (i / 400.0) * (b - a);
        for (const Point d : {Point{0.03, 0.0}, Point{-0.03, 0.0}, Point{0.0, 0.03}, Point{0.0, -0.03}})
          near = near || lies_in(kind, p + d);
      }
      if (near) continue;
      EXPECT_FALSE(enters(area, a, b)) << kind << ' ' << a.x << ',' << a.y << ' ' << b.x << ',' << b.y;
      ++beside;
    }
    EXPECT_GT(crossing, 100) << kind;
    EXPECT_GT(beside, 100) << kind;
  }
}

/// Rows along x, there and back, 0.7 mm apart, a point each 0.5 mm.
ToolPath rows() {
  ToolPath path{"file", {}, {}};
  for (int row = 0; row < 12; ++row) {
    for (int k = 0; k < 20; ++k) path.points.push_back({0.5 * (row % 2 == 0 ? k : 19 - k), 0.7 * row});
  }
  path.lifted.assign(path.points.size(), 0);
  path.lifted[0] = path.lifted[100] = 1;
  return path;
}

TEST(KeepOut, LiftsOverZonesAndLeavesOutWhatWouldComeIntoThem) {
  const ToolPath whole = rows();
  const std::vector<Aperture> zones{parse_aperture("circle:3.1,2.2,1.3"), parse_aperture("rect:6.6,4,6.9,9")};
  const SparedPath spared = keep_out_of(whole, Motion::Moving, zones);
  EXPECT_EQ(spared.path.size() + spared.left_out, whole.size());
  EXPECT_GT(spared.left_out, 10U);
  EXPECT_GT(spared.lifted_over, 5U);
  ASSERT_EQ(spared.path.notes.size(), 1U);
  for (const Stroke& s : moving_strokes(spared.path)) {
    for (const Aperture& zone : zones) {
      EXPECT_FALSE(enters(zone, s.start, s.via));
      EXPECT_FALSE(enters(zone, s.via, s.finish));
    }
  }
  // The thin rectangle, between two points of a row, is lifted over and its row keeps its points.
  const SparedPath halting = keep_out_of(whole, Motion::Stop, {zones[1]});
  EXPECT_EQ(halting.left_out, 0U);
  EXPECT_EQ(halting.lifted_over, 6U);  // rows at 4.2, 4.9, ..., 7.7 mm
}

TEST(KeepOut, LeavesAPathAsItIsThatEntersNoZone) {
  const ToolPath whole = rows();
  const SparedPath spared = keep_out_of(whole, Motion::Moving, {parse_aperture("circle:20,3,1")});
  EXPECT_EQ(spared.path.points, whole.points);
  EXPECT_EQ(spared.path.lifted, whole.lifted);
  EXPECT_TRUE(spared.path.notes.empty());
}

TEST(KeepOut, RefusesZonesThatLeaveNothing) {
  EXPECT_THROW(keep_out_of(rows(), Motion::Moving, {parse_aperture("rect:-5,-5,20,20")}), InputError);
}

}  // namespace
}  // namespace dwell
