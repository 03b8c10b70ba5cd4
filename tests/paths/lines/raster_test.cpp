#include "paths/lines/raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "paths/metrics/path_metrics.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::brute_force_distance;
using test::full_map;
using test::kInf;
using test::kNaN;
using test::map_from_picture;

RasterOptions options(double pitch) {
  RasterOptions o;
  o.pitch = pitch;
  return o;
}

const std::vector<std::string> kLShape = {
    "11......", "11......", "11......", "11111111", "11111111",
};
const std::vector<std::string> kHole = {
    "11111111", "11....11", "11....11", "1......1", "11111111",
};

void expect_points(const ToolPath& path, const std::vector<Point>& points, const std::vector<int>& lifted) {
  ASSERT_EQ(path.size(), points.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    EXPECT_NEAR(path.points[j].x, points[j].x, 1e-12) << j;
    EXPECT_NEAR(path.points[j].y, points[j].y, 1e-12) << j;
    EXPECT_EQ(static_cast<int>(path.lifted[j]), lifted[j]) << j;
  }
}

TEST(Raster, SerpentineOverARectangle) {
  const ToolPath path = raster_path(full_map(2, 3, 1.0, 1.0, {10.0, 20.0}), options(1.0));
  EXPECT_EQ(path.kind, "raster");
  expect_points(path, {{10, 20}, {11, 20}, {12, 20}, {12, 21}, {11, 21}, {10, 21}}, {1, 0, 0, 0, 0, 0});
}

TEST(Raster, OneWayLiftsEveryReturn) {
  RasterOptions o = options(1.0);
  o.serpentine = false;
  const ToolPath path = raster_path(full_map(2, 3), o);
  expect_points(path, {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}}, {1, 0, 0, 1, 0, 0});
}

TEST(Raster, RightAngleIsExactAndLinesFollowToTheLeft) {
  RasterOptions o = options(1.0);
  o.angle_deg = 90.0;
  const ToolPath path = raster_path(full_map(2, 3), o);
  const std::vector<Point> expected = {{2, 0}, {2, 1}, {1, 1}, {1, 0}, {0, 0}, {0, 1}};
  ASSERT_EQ(path.points, expected);
}

TEST(Raster, LatticeIsCentredOnTheValidPixels) {
  // Width 9 with an overrun of 0.75 on both sides: 11 points of step 1 fit, symmetric about x = 4.5; height 2 in
  // pitches of 1.5 with the overrun: 3.5 mm hold 3 lines, symmetric about y = 1.
  RasterOptions o = options(1.5);
  o.step = 1.0;
  o.overrun = 0.75;
  const ToolPath path = raster_path(full_map(3, 10), o);
  ASSERT_EQ(path.size(), 33u);
  EXPECT_DOUBLE_EQ(path.points.front().x, -0.5);
  EXPECT_DOUBLE_EQ(path.points.front().y, -0.5);
  EXPECT_DOUBLE_EQ(path.points.back().x, 9.5);
  EXPECT_DOUBLE_EQ(path.points.back().y, 2.5);
}

TEST(Raster, StepAndPitchAreIndependent) {
  RasterOptions o = options(2.0);
  o.step = 0.5;
  const ToolPath path = raster_path(full_map(5, 3), o);
  ASSERT_EQ(path.size(), 3u * 5u);
  EXPECT_DOUBLE_EQ(distance(path.points[0], path.points[1]), 0.5);
  EXPECT_DOUBLE_EQ(distance(path.points[4], path.points[5]), 2.0);
}

TEST(Raster, LShapeLinesEndWithTheShape) {
  const ToolPath path = raster_path(map_from_picture(kLShape), options(1.0));
  // Rows from below: 8, 8, 2, 2, 2 points; the second runs back, the third runs forth again from x = 0.
  ASSERT_EQ(path.size(), 22u);
  EXPECT_EQ(path.points[16], (Point{0, 2}));
  EXPECT_EQ(path.points[17], (Point{1, 2}));
  EXPECT_EQ(path.points[18], (Point{1, 3}));
  EXPECT_EQ(std::count(path.lifted.begin(), path.lifted.end(), 1), 1);
}

TEST(Raster, HolesAreCrossed) {
  const ToolPath path = raster_path(map_from_picture(kHole), options(1.0));
  EXPECT_EQ(path.size(), 40u);
  EXPECT_EQ(std::count(path.lifted.begin(), path.lifted.end(), 1), 1);
}

TEST(Raster, AGapBetweenLinesIsLifted) {
  const HeightMap islands = map_from_picture({"11.", "...", "...", "...", "111"});
  const ToolPath near = raster_path(islands, options(1.0));
  // Forth below, lifted over three empty lines, back above.
  expect_points(near, {{0, 0}, {1, 0}, {2, 0}, {1, 4}, {0, 4}}, {1, 0, 0, 1, 0});
  RasterOptions o = options(1.0);
  o.overrun = 2.0;
  const ToolPath wide = raster_path(islands, o);
  EXPECT_EQ(std::count(wide.lifted.begin(), wide.lifted.end(), 1), 1) << "an overrun of 2 closes the gap";
}

TEST(Raster, LengthsOfASerpentine) {
  // Xie et al. 2022: a serpentine over N cells of pitch g has length (N - 1) g; theirs is 5970 mm, 598 cells of 10 mm.
  const ToolPath path = raster_path(full_map(23, 26, 10.0, 10.0), options(10.0));
  const PathMetrics metrics = path_metrics(path);
  EXPECT_EQ(metrics.points, 598);
  EXPECT_NEAR(metrics.point_length, 5970.0, 1e-9);
  EXPECT_NEAR(metrics.length, 5980.0, 1e-9);
  EXPECT_EQ(metrics.lifts, 0);
}

TEST(Raster, SinglePixelGetsAPoint) {
  const ToolPath path = raster_path(map_from_picture({"...", "..1"}), options(0.3));
  expect_points(path, {{2, 0}}, {1});
}

struct Coverage {
  const std::vector<std::string>* picture;
  double pitch, step, angle, overrun;
};

class RasterCoverage : public ::testing::TestWithParam<Coverage> {};

/// An oracle of its own: every lattice point of every line against every pixel.
TEST_P(RasterCoverage, LinesRunFromFirstToLastPointWithinOverrun) {
  const Coverage c = GetParam();
  const HeightMap map = map_from_picture(*c.picture, 1.25, {-4.0, 30.0});
  RasterOptions o = options(c.pitch);
  o.step = c.step;
  o.angle_deg = c.angle;
  o.overrun = c.overrun;
  const ToolPath path = raster_path(map, o);
  const double a = c.angle * std::numbers::pi / 180.0;
  const Point along{std::cos(a), std::sin(a)}, across{-std::sin(a), std::cos(a)};

  std::map<long, std::vector<double>> lines;  // by line number relative to the first: positions along it
  const auto v_of = [&](Point p) { return across.x * p.x + across.y * p.y; };
  const double v0 = v_of(path.points[0]);
  for (const Point p : path.points) {
    const double line = (v_of(p) - v0) / c.pitch;
    ASSERT_NEAR(line, std::round(line), 1e-9) << "off the lattice";
    lines[std::lround(line)].push_back(along.x * p.x + along.y * p.y);
  }
  for (auto& [number, u] : lines) {
    std::sort(u.begin(), u.end());
    const double v = v0 + c.pitch * static_cast<double>(number);
    const auto far = [&](double s) { return brute_force_distance(map, s * along + v * across); };
    for (std::size_t i = 1; i < u.size(); ++i) ASSERT_NEAR(u[i] - u[i - 1], c.step, 1e-9);
    const double phase = (u[0] - (along.x * path.points[0].x + along.y * path.points[0].y)) / c.step;
    ASSERT_NEAR(phase, std::round(phase), 1e-9) << "lines do not share one lattice";
    const double nearest = 0.5 * std::hypot(c.pitch, c.step) + 1e-9;  // farthest a pixel's nearest lattice point can be
    EXPECT_LE(far(u.front()), std::max(c.overrun, nearest) + 1e-9);
    EXPECT_LE(far(u.back()), std::max(c.overrun, nearest) + 1e-9);
    for (int k = 1; k < 60; ++k) {  // nothing wanted was left out before or after
      EXPECT_GT(far(u.front() - k * c.step), c.overrun - 1e-9);
      EXPECT_GT(far(u.back() + k * c.step), c.overrun - 1e-9);
    }
  }
  for (const Index i : finite_pixels(map)) {
    const double v = v_of(map.grid.centre(i));
    double off = kInf;
    for (const auto& [number, u] : lines)
      off = std::min(off, std::abs(v - (v0 + c.pitch * static_cast<double>(number))));
    EXPECT_LE(off, 0.5 * c.pitch + 1e-9) << "pixel " << i << " is not covered";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, RasterCoverage,
    ::testing::Values(Coverage{&kLShape, 1.0, 0.5, 0.0, 1.5}, Coverage{&kLShape, 1.3, 0.4, 30.0, 2.0},
                      Coverage{&kLShape, 1.7, 1.7, -117.0, 0.85}, Coverage{&kHole, 0.9, 0.3, 45.0, 0.0},
                      Coverage{&kHole, 2.5, 0.7, 200.0, 1.25}, Coverage{&kHole, 0.37, 0.2, 77.0, 3.0},
                      Coverage{&kLShape, 5.0, 1.0, 10.0, 2.5}));

TEST(Raster, OverrunEqualToAWholeNumberOfStepsDoesNotDependOnRounding) {
  RasterOptions o = options(0.1);
  o.overrun = 0.3;
  o.serpentine = false;
  const HeightMap map = full_map(7, 11, 0.1, 0.1, {0.123, -7.7});
  const ToolPath path = raster_path(map, o);
  // Straight sides: 7 full lines of 11 + 2 * 3 points. Corners: at 1, 2, 3 lines beyond, an offset of k steps along is
  // within 3 for k = 2, 2, 0.
  EXPECT_EQ(path.size(), 7u * 17u + 2u * (15u + 15u + 11u));
}

TEST(Raster, RefusesBadOptions) {
  const HeightMap map = full_map(3, 3);
  const auto message = [&](const RasterOptions& o) { return test::message_of([&] { raster_path(map, o); }); };
  EXPECT_EQ(message(options(-1.0)), "raster: pitch = -1 mm; required > 0");
  EXPECT_EQ(message(options(0.0)), "raster: pitch = 0 mm; required > 0");
  EXPECT_EQ(message(options(kNaN)), "raster: pitch = nan mm; required > 0");
  EXPECT_EQ(message(options(kInf)), "raster: pitch = inf mm; required finite");
  RasterOptions o = options(1.0);
  o.step = -0.5;
  EXPECT_EQ(message(o), "raster: step = -0.5 mm; required > 0");
  o.step = kInf;
  EXPECT_EQ(message(o), "raster: step = inf mm; required finite");
  o = options(1.0);
  o.overrun = -2.0;
  EXPECT_EQ(message(o), "raster: overrun = -2 mm; required >= 0");
  o.overrun = kInf;
  EXPECT_EQ(message(o), "raster: overrun = inf mm; required finite");
  o = options(1.0);
  o.angle_deg = kNaN;
  EXPECT_EQ(message(o), "raster: angle = nan degrees; required finite");
  EXPECT_EQ(test::message_of([] {
              raster_path(HeightMap(Grid{2, 2, 1.0, 1.0, {}}), options(1.0));
            }),
            "raster: the map has no finite pixel; at least one is required");
}

TEST(Raster, RefusesAbsurdCounts) {
  const HeightMap map = full_map(101, 101);
  RasterOptions o = options(1e-3);
  EXPECT_EQ(
      test::message_of([&] { raster_path(map, o); }),
      "raster: pitch = 0.001 mm and step = 0.001 mm make 1e+05 lines of 1e+05 points, 1e+10 in all, over the part "
      "and its overrun; at most "
      "5e+07 accepted, make pitch or step larger or overrun smaller");
  o.pitch = 1e-300;
  o.step = 1e-300;
  EXPECT_NE(test::message_of([&] { raster_path(map, o); }).find("at most 5e+07 accepted"), std::string::npos);
}

}  // namespace
}  // namespace dwell
