#include "paths/lines/cross_hatch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paths/lines/raster.h"
#include "tests/paths/curves/curve_test_util.h"

namespace dwell {
namespace {

using test::full_map;
using test::kNaN;

CrossHatchOptions options(double pitch, double step, double angle, double crossing, double overrun) {
  CrossHatchOptions o;
  o.pitch = pitch;
  o.step = step;
  o.angle_deg = angle;
  o.crossing_deg = crossing;
  o.overrun = overrun;
  return o;
}

ToolPath raster(const HeightMap& map, double pitch, double step, double angle, double overrun) {
  RasterOptions o;
  o.pitch = pitch;
  o.step = step;
  o.angle_deg = angle;
  o.overrun = overrun;
  return raster_path(map, o);
}

std::vector<Point> sorted(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  return points;
}

TEST(CrossHatch, GoesOverARectangleBothWays) {
  const ToolPath path = cross_hatch_path(full_map(2, 3, 1.0, 1.0, {10.0, 20.0}), options(1.0, 1.0, 0.0, 90.0, 0.0));
  EXPECT_EQ(path.kind, "cross-hatch");
  // The first pass ends at the upper left, where the second begins: its last line (x = 10) from its far end.
  const std::vector<Point> expected{{10, 20}, {11, 20}, {12, 20}, {12, 21}, {11, 21}, {10, 21},
                                    {10, 21}, {10, 20}, {11, 20}, {11, 21}, {12, 21}, {12, 20}};
  EXPECT_EQ(path.points, expected);
  EXPECT_EQ(path.lifted, (std::vector<char>{1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}));
}

TEST(CrossHatch, IsTwoRasters) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    const ToolPath path = cross_hatch_path(part.map, options(0.9, 0.4, 20.0, 55.0, 0.7));
    const ToolPath first = raster(part.map, 0.9, 0.4, 20.0, 0.7), second = raster(part.map, 0.9, 0.4, 75.0, 0.7);
    ASSERT_EQ(path.size(), first.size() + second.size());
    const auto middle = path.points.begin() + static_cast<std::ptrdiff_t>(first.size());
    EXPECT_TRUE(std::equal(path.points.begin(), middle, first.points.begin()));
    EXPECT_TRUE(std::equal(first.lifted.begin(), first.lifted.end(), path.lifted.begin()));
    EXPECT_EQ(sorted({middle, path.points.end()}), sorted(second.points));
    EXPECT_TRUE(path.lifted[first.size()]);
    EXPECT_EQ(std::count(path.lifted.begin(), path.lifted.end(), 1),
              std::count(first.lifted.begin(), first.lifted.end(), 1) +
                  std::count(second.lifted.begin(), second.lifted.end(), 1));
    // Of the second raster's two ends, the near one or one as near begins it.
    const Point tool = *(middle - 1);
    EXPECT_LE(distance(tool, *middle), distance(tool, second.points.front()));
    EXPECT_LE(distance(tool, *middle), distance(tool, second.points.back()) + 1e-12);
  }
}

TEST(CrossHatch, RefusesBadOptions) {
  const HeightMap map = full_map(11, 7);
  const auto message = [&](const CrossHatchOptions& o) { return test::message_of([&] { cross_hatch_path(map, o); }); };
  EXPECT_EQ(message(options(-1.0, 1.0, 0.0, 90.0, 0.0)), "cross-hatch: pitch = -1 mm; required > 0");
  EXPECT_EQ(message(options(1.0, 1.0, 0.0, 180.0, 0.0)), "cross-hatch: crossing = 180 degrees; required > 0 and < 180");
  EXPECT_EQ(message(options(1.0, 1.0, 0.0, kNaN, 0.0)), "cross-hatch: crossing = nan degrees; required > 0 and < 180");
  EXPECT_NE(message(options(1e-4, 1e-3, 0.0, 90.0, 0.0)).find("at most 5e+07 accepted"), std::string::npos);
  // 38.1 million points a pass: each may be, both may not.
  EXPECT_NE(message(options(1.25e-3, 1.26e-3, 0.0, 90.0, 0.0)).find("points in both passes"), std::string::npos);
}

}  // namespace
}  // namespace dwell
