#include "paths/lines/random_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "paths/lines/raster.h"
#include "paths/path_catalogue.h"
#include "tests/paths/curves/curve_test_util.h"

namespace dwell {
namespace {

using test::full_map;
using test::kNaN;

RandomRasterOptions options(double pitch, double spread, double overrun) {
  RandomRasterOptions o;
  o.pitch = pitch;
  o.spread = spread;
  o.overrun = overrun;
  return o;
}

/// Positions across of the lines of a path at an angle, ascending.
std::vector<double> positions(const ToolPath& path, double angle_deg) {
  const double a = angle_deg * std::numbers::pi / 180.0;
  std::vector<double> all;
  for (const Point p : path.points) all.push_back(-std::sin(a) * p.x + std::cos(a) * p.y);
  std::sort(all.begin(), all.end());
  std::vector<double> lines;
  for (const double v : all) {
    if (lines.empty() || v - lines.back() > 1e-6) lines.push_back(v);
  }
  return lines;
}

TEST(RandomRaster, DistancesVaryWithinTheirBounds) {
  const ToolPath path = random_raster_path(full_map(400, 3, 0.5, 0.5, {7.0, -2.0}), options(0.8, 0.4, 1.5));
  EXPECT_EQ(path.kind, "random-raster");
  const std::vector<double> lines = positions(path, 0.0);
  ASSERT_GT(lines.size(), 200u);
  double least = 10.0, most = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double gap = lines[i] - lines[i - 1];
    least = std::min(least, gap);
    most = std::max(most, gap);
    sum += gap;
    squares += gap * gap;
  }
  const double count = static_cast<double>(lines.size() - 1), mean = sum / count;
  EXPECT_GE(least, 0.48 - 1e-9);
  EXPECT_LE(most, 1.12 + 1e-9);
  // A uniform distribution: mean 0.8, standard deviation 0.64 / sqrt(12) = 0.185; four standard errors.
  EXPECT_NEAR(mean, 0.8, 4.0 * 0.185 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), 0.185, 0.03);
  // The block of lines is centred on the part, and what is left at each side is less than half of a distance.
  EXPECT_NEAR(lines.front() + lines.back(), 2.0 * -2.0 + 399 * 0.5, 1e-9);
  EXPECT_LE(lines.front() - (-2.0 - 1.5), 0.56 + 1e-9);
}

TEST(RandomRaster, FirstDistanceIsThatOfTheStandardGenerator) {
  // mt19937_64 with its default seed 5489 begins with 14514284786278117030 (0.786820... of 2^64), as its authors' file
  // of first outputs has it.
  RandomRasterOptions o = options(1.0, 0.5, 0.0);
  o.seed = 5489;
  const std::vector<double> lines = positions(random_raster_path(full_map(100, 1), o), 0.0);
  EXPECT_NEAR(lines[1] - lines[0], 1.0 + 0.5 * (2.0 * (14514284786278117030.0 / 18446744073709551616.0) - 1.0), 1e-12);
}

TEST(RandomRaster, CoversEveryPixelAsItPromises) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    for (const double angle : {0.0, 33.0, -90.0}) {
      RandomRasterOptions o = options(1.1, 0.45, 0.0);
      o.angle_deg = angle;
      o.step = 0.3;
      o.seed = 4;
      const ToolPath path = random_raster_path(part.map, o);
      EXPECT_NO_THROW(validate(path));
      const std::vector<Stroke> strokes = moving_strokes(path);
      const std::vector<double> lines = positions(path, angle);
      const double a = angle * std::numbers::pi / 180.0;
      for (const Index i : finite_pixels(part.map)) {
        const Point p = part.map.grid.centre(i);
        double off = 10.0;
        for (const double v : lines) off = std::min(off, std::abs(-std::sin(a) * p.x + std::cos(a) * p.y - v));
        EXPECT_LE(off, 0.55 * 1.45 + 1e-9) << "pixel " << i;
        // The dwell point nearest to it along its line is there as well.
        EXPECT_LE(test::distance_to_strokes(strokes, p), std::hypot(0.55 * 1.45, 0.15) + 1e-9) << "pixel " << i;
      }
    }
  }
}

TEST(RandomRaster, HoldsTheLatticePointsWithinOverrun) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    RandomRasterOptions o = options(0.9, 0.3, 1.3);
    o.step = 0.35;
    const ToolPath path = random_raster_path(part.map, o);
    // A line ends where the next point on either side is beyond the overrun, or would be off the lattice.
    const std::vector<double> lines = positions(path, 0.0);
    for (const double y : lines) {
      double low = 1e9, high = -1e9;
      for (const Point p : path.points) {
        if (std::abs(p.y - y) > 1e-6) continue;
        low = std::min(low, p.x);
        high = std::max(high, p.x);
      }
      const double nearest = std::hypot(0.5 * 0.9 * 1.3, 0.5 * 0.35);
      EXPECT_LE(test::brute_force_distance(part.map, {low, y}), std::max(1.3, nearest) + 1e-9);
      EXPECT_LE(test::brute_force_distance(part.map, {high, y}), std::max(1.3, nearest) + 1e-9);
      for (int k = 1; k < 40; ++k) {
        EXPECT_GT(test::brute_force_distance(part.map, {low - 0.35 * k, y}), 1.3 - 1e-9);
        EXPECT_GT(test::brute_force_distance(part.map, {high + 0.35 * k, y}), 1.3 - 1e-9);
      }
    }
  }
}

TEST(RandomRaster, WithoutSpreadIsARaster) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    const ToolPath path = random_raster_path(part.map, options(0.9, 0.0, 0.7));
    RasterOptions o;
    o.pitch = 0.9;
    o.overrun = 0.7;
    const ToolPath raster = raster_path(part.map, o);
    ASSERT_EQ(path.size(), raster.size());
    EXPECT_EQ(path.lifted, raster.lifted);
    for (std::size_t j = 0; j < path.size(); ++j) EXPECT_LE(distance(path.points[j], raster.points[j]), 1e-9);
  }
}

TEST(RandomRaster, SeedsDecide) {
  const HeightMap part = test::blob(3);
  RandomRasterOptions o = options(0.9, 0.3, 0.7);
  const ToolPath one = random_raster_path(part, o);
  EXPECT_TRUE(test::same_bytes(one, random_raster_path(part, o)));
  o.seed = 2;
  EXPECT_FALSE(test::same_bytes(one, random_raster_path(part, o)));
}

TEST(RandomRaster, ReadsSpreadsInMillimetresAndPercent) {
  const auto spread = [](const char* text) { return options_of<RandomRasterOptions>(parse_path_spec(text)).spread; };
  EXPECT_DOUBLE_EQ(spread("random-raster:pitch=2,spread=0.5"), 0.25);
  EXPECT_DOUBLE_EQ(spread("random-raster:pitch=2,spread=40%"), 0.4);
  EXPECT_DOUBLE_EQ(spread("random-raster:pitch=2"), 0.3);
  const auto message = [](const std::string& text) { return test::message_of([&] { parse_path_spec(text); }); };
  EXPECT_EQ(
      message("random-raster:pitch=2,spread=%"),
      "path \"random-raster:pitch=2,spread=%\": spread = \"%\"; required a length in mm or a share of the pitch, for "
      "instance spread=20%");
  for (const char* seed : {"-1", "1.5", "1e16", "inf"}) {
    const std::string text = std::string("random-raster:pitch=1,seed=") + seed;
    EXPECT_EQ(message(text), "path \"" + text + "\": seed = \"" + seed + "\"; required a whole number from 0 to 2^53");
  }
}

TEST(RandomRaster, RefusesBadOptions) {
  const HeightMap map = full_map(11, 7);
  const auto message = [&](const RandomRasterOptions& o) {
    return test::message_of([&] { random_raster_path(map, o); });
  };
  EXPECT_EQ(message(options(0.0, 0.3, 0.0)), "random-raster: pitch = 0 mm; required > 0");
  EXPECT_EQ(message(options(2.0, 1.0, 0.0)),
            "random-raster: spread = 2 mm, 1 of the pitch; required >= 0 and less than the pitch");
  EXPECT_NE(message(options(2.0, -0.1, 0.0)).find("required >= 0 and less than the pitch"), std::string::npos);
  EXPECT_NE(message(options(2.0, kNaN, 0.0)).find("required >= 0 and less than the pitch"), std::string::npos);
  EXPECT_NE(message(options(1e-4, 0.3, 0.0)).find("at most 5e+07 accepted"), std::string::npos);
}

}  // namespace
}  // namespace dwell
