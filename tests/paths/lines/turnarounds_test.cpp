#include "paths/lines/turnarounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "paths/lines/cross_hatch.h"
#include "paths/lines/random_raster.h"
#include "paths/lines/raster.h"
#include "tests/paths/curves/curve_test_util.h"

namespace dwell {
namespace {

using std::numbers::pi;
using test::full_map;
using test::sharpest_stroke_corner;

RasterOptions options(double pitch, double step, Turnaround turn, double corner = 0.0) {
  RasterOptions o;
  o.pitch = pitch;
  o.step = step;
  o.turns = {turn, corner};
  return o;
}

TEST(Turnarounds, ArcJoinsEqualEndsByAHalfCircle) {
  const ToolPath path = raster_path(full_map(3, 6, 1.0, 2.0, {10.0, 20.0}), options(2.0, 1.0, Turnaround::Arc));
  ASSERT_EQ(path.size(), 3u * 6u + 2u * 6u);
  for (int i = 0; i < 6; ++i) {
    const double turned = pi * (i + 0.5) / 6.0;
    EXPECT_LE(distance(path.points[static_cast<std::size_t>(6 + i)], {15 + std::sin(turned), 21 - std::cos(turned)}),
              1e-12);
    EXPECT_LE(distance(path.points[static_cast<std::size_t>(18 + i)], {10 - std::sin(turned), 23 - std::cos(turned)}),
              1e-12);
  }
  EXPECT_EQ(path.points[12], (Point{15, 22}));
  EXPECT_LE(sharpest_stroke_corner(path), 30.0 + 1e-6);
  EXPECT_EQ(std::count(path.lifted.begin(), path.lifted.end(), 1), 1);
}

TEST(Turnarounds, ArcIsLevelWithTheOuterOfUnequalEnds) {
  // Widths from below: 3, 6, 2. To the right the second line is longer; to the left both begin at x = 0.
  const HeightMap map = test::map_from_picture({"11....", "111111", "111..."});
  const ToolPath path = raster_path(map, options(1.0, 1.0, Turnaround::Arc));
  // Line 0: x = 0, 1, 2, on to 3, 4, 5; half circle about (5, 0.5); line 1 from 5 to 0; half circle about (0, 1.5).
  ASSERT_EQ(path.size(), 6u + 6u + 6u + 6u + 2u);
  EXPECT_EQ(path.points[5], (Point{5, 0}));
  EXPECT_LE(distance(path.points[6], {5 + 0.5 * std::sin(pi / 12), 0.5 - 0.5 * std::cos(pi / 12)}), 1e-12);
  EXPECT_EQ(path.points[12], (Point{5, 1}));
  EXPECT_EQ(path.points[24], (Point{0, 2}));
  EXPECT_LE(sharpest_stroke_corner(path), 30.0 + 1e-6);
  // The other way round: the line that comes is the shorter one, and is begun farther out.
  const HeightMap upside_down = test::map_from_picture({"111...", "111111"});
  const ToolPath back = raster_path(upside_down, options(1.0, 1.0, Turnaround::Arc));
  ASSERT_EQ(back.size(), 6u + 6u + 6u);
  EXPECT_EQ(back.points[12], (Point{5, 1}));
  EXPECT_EQ(back.points[17], (Point{0, 1}));
  EXPECT_LE(sharpest_stroke_corner(back), 30.0 + 1e-6);
}

TEST(Turnarounds, ArcHasPointsAtTheStep) {
  const ToolPath path = raster_path(full_map(2, 4, 1.0, 8.0), options(8.0, 0.5, Turnaround::Arc));
  EXPECT_EQ(path.size(), 2u * 7u + 25u);  // 4 pi mm at 0.5 mm
  EXPECT_LE(test::longest_move_on_part(path), 0.51);
}

TEST(Turnarounds, LiftTakesTheToolUpBetweenLines) {
  const ToolPath path = raster_path(full_map(3, 4), options(1.0, 1.0, Turnaround::Lift));
  EXPECT_EQ(path.lifted, (std::vector<char>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(path.points[4], (Point{3, 1})) << "still a serpentine";
}

TEST(Turnarounds, StrokesTurnSmoothlyOnEveryPart) {
  for (const test::Aperture& part : test::apertures()) {
    for (const double step : {0.2, 0.9, 2.5}) {
      SCOPED_TRACE(part.name + ", step " + std::to_string(step));
      RasterOptions raster = options(0.9, step, Turnaround::Arc);
      raster.overrun = 0.5;
      raster.angle_deg = 25.0;
      const ToolPath arcs = raster_path(part.map, raster);
      EXPECT_NO_THROW(validate(arcs));
      EXPECT_LE(sharpest_stroke_corner(arcs), 30.0 + 1e-6);
      EXPECT_LE(test::longest_move_on_part(arcs), 6.5 / 6.0 * step + 1e-9);
      const ToolPath square = [&] {
        RasterOptions o = raster;
        o.turns = {};
        return raster_path(part.map, o);
      }();
      EXPECT_EQ(std::count(arcs.lifted.begin(), arcs.lifted.end(), 1),
                std::count(square.lifted.begin(), square.lifted.end(), 1));

      RandomRasterOptions random;
      random.pitch = 0.9;
      random.step = step;
      random.turns = {Turnaround::Arc, 0.0};
      EXPECT_LE(sharpest_stroke_corner(random_raster_path(part.map, random)), 30.0 + 1e-6);
      CrossHatchOptions cross;
      cross.pitch = 0.9;
      cross.step = step;
      cross.turns = {Turnaround::Arc, 0.0};
      EXPECT_LE(sharpest_stroke_corner(cross_hatch_path(part.map, cross)), 30.0 + 1e-6);
    }
  }
}

TEST(Turnarounds, CornersOfARectanglesRasterAreRounded) {
  const HeightMap map = full_map(9, 14, 0.5, 0.5, {1.0, -2.0});
  const ToolPath path = raster_path(map, options(1.0, 0.25, Turnaround::Square, 0.4));
  EXPECT_LE(sharpest_stroke_corner(path), 30.0 + 1e-6);
  ASSERT_EQ(path.notes.size(), 1u);
  EXPECT_EQ(path.notes[0], "corners rounded with radius 0.4 mm: 8");
  const ToolPath most = raster_path(map, options(1.0, 0.25, Turnaround::Square, 3.0));
  EXPECT_LE(sharpest_stroke_corner(most), 30.0 + 1e-6);
  EXPECT_NE(most.notes[0].find("least 0.5 mm"), std::string::npos) << "half of the pitch: " << most.notes[0];
  RandomRasterOptions random;
  random.pitch = 1.0;
  random.turns.corner = 0.1;
  EXPECT_LE(sharpest_stroke_corner(random_raster_path(map, random)), 30.0 + 1e-6);
  CrossHatchOptions cross;
  cross.pitch = 1.0;
  cross.turns.corner = 0.1;
  EXPECT_LE(sharpest_stroke_corner(cross_hatch_path(map, cross)), 30.0 + 1e-6);
}

TEST(Turnarounds, RefusesWhatCannotBe) {
  const HeightMap map = full_map(5, 4);
  RasterOptions o = options(1.0, 1.0, Turnaround::Arc);
  o.serpentine = false;
  EXPECT_EQ(test::message_of([&] { raster_path(map, o); }),
            "raster: turn = arc with order = one-way, whose returns are lifted; required order = serpentine, or turn = "
            "lift");
  o = options(1.0, 1.0, Turnaround::Square, -0.5);
  EXPECT_EQ(test::message_of([&] { raster_path(map, o); }), "raster: corner = -0.5 mm; required finite and >= 0");
  // One column: a point a line, but arcs without end.
  EXPECT_NE(test::message_of([&] {
              raster_path(full_map(5, 1), options(1.0, 1e-320, Turnaround::Arc));
            }).find("at most 5e+07"),
            std::string::npos);
}

}  // namespace
}  // namespace dwell
