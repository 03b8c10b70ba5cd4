#include "paths/curves/circles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/paths/curves/curve_test_util.h"

namespace dwell {
namespace {

using std::numbers::pi;
using test::full_map;
using test::kInf;
using test::kNaN;

CirclesOptions circles_options(double pitch, double step, double overrun) {
  CirclesOptions o;
  o.pitch = pitch;
  o.step = step;
  o.overrun = overrun;
  return o;
}

TEST(Circles, OfADiscAreWholeAndLinkedAcrossARay) {
  const Point centre{3.0, -7.0};
  // One pixel widened by 4.6 mm: circles of radius 0.5, 1.5, 2.5, 3.5, 4.5 with step 0.8.
  const ToolPath path = circles_path(full_map(1, 1, 0.1, 0.1, centre), circles_options(1.0, 0.8, 4.6));
  EXPECT_EQ(path.kind, "circles");
  EXPECT_TRUE(path.notes.empty());
  EXPECT_EQ(std::count(path.lifted.begin(), path.lifted.end(), 1), 1);
  std::size_t j = 0;
  for (const auto& [radius, count] : {std::pair{0.5, 4}, {1.5, 12}, {2.5, 20}, {3.5, 27}, {4.5, 35}}) {
    for (int k = 0; k < count; ++k, ++j) {
      ASSERT_LT(j, path.size());
      const double angle = 2.0 * pi * (k + 0.5) / count;
      EXPECT_LE(distance(path.points[j], centre + radius * Point{std::cos(angle), std::sin(angle)}), 1e-12) << j;
    }
  }
  EXPECT_EQ(j, path.size());
  EXPECT_LE(test::longest_move_on_part(path), 1.0 + 0.8 * 7.0 / 6.0);
}

TEST(Circles, StrokesOfADiscGoRoundEveryCircle) {
  const ToolPath path = circles_path(full_map(1, 1, 0.1, 0.1, {0.5, 2.0}), circles_options(1.0, 0.1, 6.0));
  const std::vector<Stroke> strokes = moving_strokes(path);
  for (double angle = 0.01; angle < 6.28; angle += 0.137) {
    for (const double radius : {1.5, 5.5}) {
      // But for the corner cut at the ray, within half a step of it.
      const Point p = Point{0.5, 2.0} + radius * Point{std::cos(angle), std::sin(angle)};
      if (radius * std::min(angle, 2.0 * pi - angle) > 0.06) {
        EXPECT_LE(test::distance_to_strokes(strokes, p), 1.5e-3) << angle;
      }
    }
  }
}

TEST(Circles, TurnAndDirection) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    CirclesOptions o = circles_options(0.9, 0.3, 1.0);
    const ToolPath out = circles_path(part.map, o);
    o.from_edge = true;
    EXPECT_TRUE(test::reversed(out, circles_path(part.map, o)));
  }
  const Point centre{-6.0, 1.0};
  CirclesOptions o = circles_options(0.9, 0.3, 5.0);
  const ToolPath left = circles_path(full_map(1, 1, 0.1, 0.1, centre), o);
  o.clockwise = true;
  const ToolPath right = circles_path(full_map(1, 1, 0.1, 0.1, centre), o);
  ASSERT_EQ(left.size(), right.size());
  EXPECT_GT(left.points[0].y, centre.y) << "counter-clockwise: from the ray along +x upwards";
  for (std::size_t j = 0; j < left.size(); ++j) {
    EXPECT_NEAR(left.points[j].y - centre.y, centre.y - right.points[j].y, 1e-12);
  }
}

/// Every point of every circle against every pixel.
TEST(Circles, HoldThePointsWithinReachAndNoOthers) {
  for (const test::Aperture& part : test::apertures()) {
    const Grid& g = part.map.grid;
    for (const Point shift : {Point{4.0, 3.0}, Point{-9.0, 3.0}, Point{20.0, 31.0}}) {
      SCOPED_TRACE(part.name);
      const double pitch = 0.8, step = 0.35, overrun = 0.65;
      CirclesOptions o = circles_options(pitch, step, overrun);
      const Point centre = g.centre(0, 0) + shift;
      o.centre = centre;
      const ToolPath path = circles_path(part.map, o);
      const double reach = std::max(overrun, 0.5 * std::hypot(g.pitch_x, g.pitch_y));
      std::set<std::pair<int, int>> wanted;  // circle, point of it
      double far = 0.0;
      for (const Index i : finite_pixels(part.map)) far = std::max(far, distance(g.centre(i), centre) + reach);
      const auto number_on = [&](int circle) {
        return std::max(3, static_cast<int>(std::lround(2.0 * pi * (circle + 0.5) * pitch / step)));
      };
      for (int circle = 0; (circle + 0.5) * pitch <= far; ++circle) {
        for (int k = 0; k < number_on(circle); ++k) {
          const double angle = 2.0 * pi * (k + 0.5) / number_on(circle);
          const Point p = centre + ((circle + 0.5) * pitch) * Point{std::cos(angle), std::sin(angle)};
          if (test::brute_force_distance(part.map, p) <= reach) wanted.insert({circle, k});
        }
      }
      ASSERT_EQ(path.size(), wanted.size());
      int last_circle = -1;
      for (std::size_t j = 0; j < path.size(); ++j) {
        const Point q = path.points[j] - centre;
        const int circle = static_cast<int>(std::lround(length(q) / pitch - 0.5));
        const double turns = std::atan2(q.y, q.x) / (2.0 * pi);
        const int n = number_on(circle);
        const int k = static_cast<int>(std::lround((turns < 0.0 ? turns + 1.0 : turns) * n - 0.5));
        EXPECT_EQ(wanted.erase({circle, k}), 1u) << "not wanted, or twice: point " << j;
        EXPECT_GE(circle, last_circle);
        last_circle = circle;
      }
      EXPECT_TRUE(wanted.empty());
      EXPECT_LE(test::longest_move_on_part(path), pitch + step * 7.0 / 6.0 + 1e-9);
      EXPECT_NO_THROW(validate(path));
    }
  }
}

TEST(Circles, CoverEveryPixelWhateverTheOverrun) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    const ToolPath path = circles_path(part.map, circles_options(1.1, 0.15, 0.0));
    const std::vector<Stroke> strokes = moving_strokes(path);
    for (const Index i : finite_pixels(part.map)) {
      // The dwell points cut circles short by their sagitta, at most 0.15^2 / (8 * 0.55) mm.
      EXPECT_LE(test::distance_to_strokes(strokes, part.map.grid.centre(i)), 0.55 + 0.006) << "pixel " << i;
    }
  }
}

TEST(Circles, SayHowManyAreBroken) {
  const ToolPath path = circles_path(full_map(5, 9), circles_options(1.0, 0.5, 0.0));
  ASSERT_EQ(path.notes.size(), 1u);
  EXPECT_NE(path.notes[0].find("circles are broken by the edge of the part and run in pieces"), std::string::npos);
}

TEST(Circles, RefuseBadOptions) {
  const HeightMap map = full_map(11, 7);
  const auto message = [&](const CirclesOptions& o) { return test::message_of([&] { circles_path(map, o); }); };
  EXPECT_EQ(message(circles_options(0.0, 1.0, 0.0)), "circles: pitch = 0 mm; required > 0");
  EXPECT_EQ(message(circles_options(1.0, kNaN, 0.0)), "circles: step = nan mm; required > 0");
  EXPECT_EQ(message(circles_options(1.0, 1.0, kInf)), "circles: overrun = inf mm; required finite and >= 0");
  EXPECT_NE(message(circles_options(1e-3, 1e-3, 0.0)).find("at most 5e+07 accepted"), std::string::npos);
  EXPECT_NE(message(circles_options(1.0, 1e-320, 0.0)).find("at most 5e+07 accepted"), std::string::npos);
}

}  // namespace
}  // namespace dwell
