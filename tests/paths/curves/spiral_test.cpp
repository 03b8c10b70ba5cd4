#include "paths/curves/spiral.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/paths/curves/curve_test_util.h"

namespace dwell {
namespace {

using std::numbers::pi;
using test::full_map;
using test::kInf;
using test::kNaN;

SpiralOptions spiral_options(double pitch, double step, double overrun) {
  SpiralOptions o;
  o.pitch = pitch;
  o.step = step;
  o.overrun = overrun;
  return o;
}

/// A domain that is a disc: one pixel, widened by the overrun.
HeightMap pixel_at(Point p) { return full_map(1, 1, 0.1, 0.1, p); }

/// Length of the polar curve rho = a theta by Simpson's rule on sqrt(rho^2 + rho'^2).
double quadrature(double a, double from, double to, int intervals) {
  const auto speed = [a](double theta) { return std::hypot(a * theta, a); };
  const double h = (to - from) / (2.0 * intervals);
  double sum = speed(from) + speed(to);
  for (int i = 1; i < 2 * intervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * speed(from + h * i);
  return sum * h / 3.0;
}

void expect_equal_arcs(const ToolPath& path, Point centre, double pitch, double step) {
  const double a = pitch / (2.0 * pi);
  double before = 0.0, arc = 0.0, worst = 0.0, off = 0.0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Point p = path.points[k] - centre;
    const double theta = length(p) / a;
    arc += quadrature(a, before, theta, k < 20 ? 200 : 8);
    worst = std::max(worst, std::abs(arc - step * static_cast<double>(k)));
    off = std::max(off, length(p - length(p) * Point{std::cos(theta), std::sin(theta)}));
    before = theta;
  }
  EXPECT_LE(worst, 1e-8) << "arc lengths are not multiples of the step";
  EXPECT_LE(off, 1e-9) << "off the spiral";
}

TEST(Spiral, PointsLieAtEqualArcLengthsOfTheCurve) {
  for (const auto& [pitch, step, reach] : {std::array{1.3, 0.4, 20.0}, {2.0, 5.0, 61.0}, {0.5, 0.07, 7.0}}) {
    const ToolPath path = spiral_path(pixel_at({3.0, -7.0}), spiral_options(pitch, step, reach));
    EXPECT_EQ(path.kind, "spiral");
    expect_equal_arcs(path, {3.0, -7.0}, pitch, step);
    const double whole = quadrature(pitch / (2.0 * pi), 0.0, 2.0 * pi * reach / pitch, 20000);
    EXPECT_EQ(path.size(), static_cast<std::size_t>(std::floor(whole / step)) + 1);
    EXPECT_EQ(std::count(path.lifted.begin(), path.lifted.end(), 1), 1);
    EXPECT_TRUE(path.notes.empty());
  }
}

TEST(Spiral, ArcLengthsStayEqualFarOut) {
  const ToolPath path = spiral_path(pixel_at({-2.0, 5.0}), spiral_options(1.0, 0.5, 150.0));  // to theta = 942
  ASSERT_GT(path.size(), 140000u);
  expect_equal_arcs(path, {-2.0, 5.0}, 1.0, 0.5);
}

TEST(Spiral, FirstPointsInClosedForm) {
  // s(pi / 2) of rho = L theta / 2 pi for L = 2 pi: (pi / 2 sqrt(1 + pi^2 / 4) + asinh(pi / 2)) / 2 = 2.0792...
  const double quarter = 0.5 * (0.5 * pi * std::hypot(1.0, 0.5 * pi) + std::asinh(0.5 * pi));
  const ToolPath path = spiral_path(pixel_at({10.0, 20.0}), spiral_options(2.0 * pi, quarter, 9.0));
  ASSERT_GE(path.size(), 2u);
  EXPECT_EQ(path.points[0], (Point{10.0, 20.0}));
  EXPECT_NEAR(path.points[1].x, 10.0, 1e-12);
  EXPECT_NEAR(path.points[1].y, 20.0 + 0.5 * pi, 1e-12) << "counter-clockwise: the first quarter turn ends above";
}

TEST(Spiral, TurnsTheOtherWayAndRunsInwards) {
  SpiralOptions o = spiral_options(0.9, 0.3, 1.0);
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    o.clockwise = false;
    o.from_edge = false;
    const ToolPath out = spiral_path(part.map, o);
    o.from_edge = true;
    EXPECT_TRUE(test::reversed(out, spiral_path(part.map, o)));
  }
  const Point centre{1.5, -4.0};
  const SpiralOptions disc = spiral_options(0.9, 0.3, 6.0);
  SpiralOptions clockwise = disc;
  clockwise.clockwise = true;
  const ToolPath left = spiral_path(pixel_at(centre), disc), right = spiral_path(pixel_at(centre), clockwise);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t j = 0; j < left.size(); ++j) {
    EXPECT_NEAR(left.points[j].x, right.points[j].x, 1e-12);
    EXPECT_NEAR(left.points[j].y - centre.y, centre.y - right.points[j].y, 1e-12);
  }
}

/// All points of the spiral, by bisection, that a look at every pixel lets in.
void expect_same_as_bisection(const HeightMap& map, Point centre, double pitch, double step, double reach,
                              const ToolPath& path) {
  const double a = pitch / (2.0 * pi);
  double far = 0.0;
  for (const Index i : finite_pixels(map)) far = std::max(far, distance(map.grid.centre(i), centre) + reach);
  const auto arc = [a](double theta) { return 0.5 * a * (theta * std::sqrt(1.0 + theta * theta) + std::asinh(theta)); };
  std::size_t next = 0;
  bool outside = true;
  for (int k = 0;; ++k) {
    double low = 0.0, high = (far + pitch) / a;
    if (arc(high) < step * k) break;
    for (int i = 0; i < 80; ++i) (arc(0.5 * (low + high)) < step * k ? low : high) = 0.5 * (low + high);
    const Point p = centre + (a * low) * Point{std::cos(low), std::sin(low)};
    const bool in = test::brute_force_distance(map, p) <= reach;
    if (in) {
      ASSERT_LT(next, path.size());
      ASSERT_LE(distance(path.points[next], p), 1e-8) << "point " << next;
      ASSERT_EQ(path.lifted[next] != 0, outside) << "point " << next;
      ++next;
    }
    outside = !in;
  }
  EXPECT_EQ(next, path.size());
}

TEST(Spiral, HoldsThePointsWithinReachAndNoOthers) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    const Grid& g = part.map.grid;
    const Point corner = g.centre(0, 0);
    for (const Point shift : {Point{0.3, 0.2}, Point{-9.0, 3.0}, Point{20.0, 31.0}}) {
      SpiralOptions o = spiral_options(0.8, 0.35, 0.65);
      o.centre = corner + shift;
      const ToolPath path = spiral_path(part.map, o);
      const double reach = std::max(0.65, 0.5 * std::hypot(g.pitch_x, g.pitch_y));
      expect_same_as_bisection(part.map, *o.centre, 0.8, 0.35, reach, path);
      EXPECT_LE(test::longest_move_on_part(path), 0.35 + 1e-9);
      EXPECT_NO_THROW(validate(path));
    }
  }
}

TEST(Spiral, CoversEveryPixelWhateverTheOverrun) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    const ToolPath path = spiral_path(part.map, spiral_options(1.1, 0.2, 0.0));
    const std::vector<Stroke> strokes = moving_strokes(path);
    for (const Index i : finite_pixels(part.map)) {
      // The dwell points cut the curve short by its sagitta: at most 0.01 mm in the innermost turn.
      EXPECT_LE(test::distance_to_strokes(strokes, part.map.grid.centre(i)), 0.55 + 0.01) << "pixel " << i;
    }
  }
}

TEST(Spiral, TheMiddleOfTheBoxIsTheDefaultCentre) {
  const HeightMap map = test::map_from_picture({"......", ".11...", ".1111.", "......"}, 2.0, {5.0, -3.0});
  EXPECT_EQ(spiral_path(map, spiral_options(1.0, 0.5, 0.0)).points[0], (Point{10.0, 0.0}));
}

TEST(Spiral, SaysWhereItIsLifted) {
  const HeightMap part = test::apertures()[3].map;
  const ToolPath path = spiral_path(part, spiral_options(0.8, 0.35, 0.0));
  const auto lifts = std::count(path.lifted.begin(), path.lifted.end(), 1) - 1;
  ASSERT_GT(lifts, 0);
  ASSERT_EQ(path.notes.size(), 1u);
  EXPECT_EQ(path.notes[0], "the spiral leaves the part " + std::to_string(lifts) + " times; it is lifted there");
}

TEST(Spiral, RefusesBadOptions) {
  const HeightMap map = full_map(11, 7);
  const auto message = [&](const SpiralOptions& o) { return test::message_of([&] { spiral_path(map, o); }); };
  EXPECT_EQ(message(spiral_options(-1.0, 1.0, 0.0)), "spiral: pitch = -1 mm; required > 0");
  EXPECT_EQ(message(spiral_options(kNaN, 1.0, 0.0)), "spiral: pitch = nan mm; required > 0");
  EXPECT_EQ(message(spiral_options(kInf, 1.0, 0.0)), "spiral: pitch = inf mm; required finite");
  EXPECT_EQ(message(spiral_options(1.0, 0.0, 0.0)), "spiral: step = 0 mm; required > 0");
  EXPECT_EQ(message(spiral_options(1.0, kInf, 0.0)), "spiral: step = inf mm; required finite");
  EXPECT_EQ(message(spiral_options(1.0, 1.0, -2.0)), "spiral: overrun = -2 mm; required finite and >= 0");
  SpiralOptions o = spiral_options(1.0, 1.0, 0.0);
  o.centre = Point{0.0, kInf};
  EXPECT_EQ(message(o), "spiral: centre = 0/inf mm; required finite");
  EXPECT_NE(message(spiral_options(1e-3, 1e-3, 0.0)).find("at most 5e+07 accepted"), std::string::npos);
  EXPECT_NE(message(spiral_options(1.0, 1e-320, 0.0)).find("make inf points"), std::string::npos);
  EXPECT_EQ(test::message_of([] {
              spiral_path(HeightMap(Grid{2, 2, 1.0, 1.0, {}}), spiral_options(1.0, 1.0, 0.0));
            }),
            "spiral: the map has no finite pixel; at least one is required");
}

}  // namespace
}  // namespace dwell
