#include "paths/curves/fibonacci.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "paths/metrics/path_metrics.h"
#include "tests/paths/curves/curve_test_util.h"

namespace dwell {
namespace {

using std::numbers::pi;
using test::full_map;
using test::kInf;
using test::kNaN;

FibonacciOptions options(double pitch, double overrun) {
  FibonacciOptions o;
  o.pitch = pitch;
  o.overrun = overrun;
  return o;
}

Point lattice_point(Point centre, double pitch, Index k) {
  const long double turns = static_cast<long double>(k) * 0.38196601125010515179541316563436188L;
  const auto angle = static_cast<double>(2.0L * std::numbers::pi_v<long double> * (turns - std::floor(turns)));
  return centre + (pitch * std::sqrt((static_cast<double>(k) + 0.5) / pi)) * Point{std::cos(angle), std::sin(angle)};
}

/// Every point of the lattice against every pixel.
TEST(Fibonacci, HoldsThePointsWithinReachEachOnce) {
  for (const test::Aperture& part : test::apertures()) {
    const Grid& g = part.map.grid;
    for (const Point shift : {Point{4.0, 3.0}, Point{-9.0, 3.0}, Point{20.0, 31.0}}) {
      SCOPED_TRACE(part.name);
      const double pitch = 0.9, overrun = 0.75;
      FibonacciOptions o = options(pitch, overrun);
      o.centre = g.centre(0, 0) + shift;
      const ToolPath path = fibonacci_path(part.map, o);
      const double reach = std::max(overrun, 0.5 * std::hypot(g.pitch_x, g.pitch_y));
      std::set<Index> wanted;
      double far = 0.0;
      for (const Index i : finite_pixels(part.map)) far = std::max(far, distance(g.centre(i), *o.centre) + reach);
      for (Index k = 0; k <= static_cast<Index>(pi * far * far / (pitch * pitch)) + 2; ++k) {
        if (test::brute_force_distance(part.map, lattice_point(*o.centre, pitch, k)) <= reach) wanted.insert(k);
      }
      ASSERT_EQ(path.size(), wanted.size());
      for (const Point p : path.points) {
        const double rho = distance(p, *o.centre) / pitch;
        const auto k = static_cast<Index>(std::lround(pi * rho * rho - 0.5));
        EXPECT_LE(distance(p, lattice_point(*o.centre, pitch, k)), 1e-9);
        EXPECT_EQ(wanted.erase(k), 1u) << "not wanted, or twice: " << k;
      }
      EXPECT_LE(test::longest_move_on_part(path), 2.5 * pitch);
      EXPECT_NO_THROW(validate(path));
    }
  }
}

TEST(Fibonacci, CoversEveryPixelWhateverTheOverrun) {
  for (const test::Aperture& part : test::apertures()) {
    SCOPED_TRACE(part.name);
    const ToolPath path = fibonacci_path(part.map, options(1.2, 0.0));
    for (const Index i : finite_pixels(part.map)) {
      double nearest = kInf;
      for (const Point p : path.points) nearest = std::min(nearest, distance(p, part.map.grid.centre(i)));
      EXPECT_LE(nearest, 0.78 * 1.2) << "pixel " << i;
    }
  }
}

TEST(Fibonacci, NoPlaceIsFartherFromThePointsThanPromised) {
  const ToolPath path = fibonacci_path(full_map(1, 1, 0.1, 0.1, {5.0, -3.0}), options(1.0, 14.0));
  EXPECT_NEAR(static_cast<double>(path.size()), pi * 14.0 * 14.0, 2.0) << "one point per pitch^2";
  double near_centre = 0.0, farther = 0.0;
  for (double x = -12.0; x <= 12.0; x += 0.06) {
    for (double y = -12.0; y <= 12.0; y += 0.06) {
      if (std::hypot(x, y) > 12.0) continue;
      double nearest = kInf;
      for (const Point p : path.points) nearest = std::min(nearest, distance(p, Point{5.0 + x, -3.0 + y}));
      (std::hypot(x, y) < 3.0 ? near_centre : farther) =
          std::max(std::hypot(x, y) < 3.0 ? near_centre : farther, nearest);
    }
  }
  EXPECT_LE(near_centre, 0.78);
  EXPECT_LE(farther, 0.71);
  EXPECT_GE(near_centre, 0.70) << "the sampling sees the gap at the centre";
}

TEST(Fibonacci, TourOfADiscIsShort) {
  const ToolPath path = fibonacci_path(full_map(1, 1, 0.1, 0.1, {5.0, -3.0}), options(1.0, 60.0));  // 11310 points
  const PathMetrics metrics = path_metrics(path);
  const double ratio = metrics.point_length / static_cast<double>(metrics.points - 1);
  EXPECT_LE(ratio, 1.02);
  EXPECT_LE(metrics.lifts, 40);
  ASSERT_EQ(path.notes.size(), 1u);
  EXPECT_NE(path.notes[0].find("times (points - 1) * pitch long"), std::string::npos);
  // Along the arms of a ring all moves are as the docstring says: the middle ones of the sorted lengths.
  std::vector<double> moves;
  for (std::size_t j = 1; j < path.size(); ++j) moves.push_back(distance(path.points[j - 1], path.points[j]));
  std::sort(moves.begin(), moves.end());
  EXPECT_GE(moves[moves.size() / 20], 0.94);
  EXPECT_LE(moves[moves.size() * 8 / 10], 1.005);
}

TEST(Fibonacci, RunsPiecesOnOneSideOfAHoleFirst) {
  HeightMap map = full_map(60, 80, 0.5, 0.5, {1.0, 2.0});
  for (Index i = 0; i < map.grid.size(); ++i) {
    if (distance(map.grid.centre(i), {30.0, 14.0}) < 6.0) map.values[static_cast<std::size_t>(i)] = kNaN;
  }
  const ToolPath path = fibonacci_path(map, options(0.5, 0.0));
  // A hole of 24 pitches cuts some 40 arms; lifting at every crossing would take as many moves.
  EXPECT_LE(std::count(path.lifted.begin(), path.lifted.end(), 1), 60);
  EXPECT_LE(path_metrics(path).point_length / (0.5 * static_cast<double>(path.size() - 1)), 1.1);
}

TEST(Fibonacci, RefusesBadOptions) {
  const HeightMap map = full_map(11, 7);
  const auto message = [&](const FibonacciOptions& o) { return test::message_of([&] { fibonacci_path(map, o); }); };
  EXPECT_EQ(message(options(-1.0, 0.0)), "fibonacci: pitch = -1 mm; required > 0");
  EXPECT_EQ(message(options(kInf, 0.0)), "fibonacci: pitch = inf mm; required finite");
  EXPECT_EQ(message(options(1.0, kNaN)), "fibonacci: overrun = nan mm; required finite and >= 0");
  FibonacciOptions o = options(1.0, 0.0);
  o.centre = Point{kNaN, 0.0};
  EXPECT_EQ(message(o), "fibonacci: centre = nan/0 mm; required finite");
  EXPECT_NE(message(options(1e-3, 0.0)).find("at most 5e+07 accepted"), std::string::npos);
  EXPECT_NE(message(options(1e-320, 0.0)).find("at most 5e+07 accepted"), std::string::npos);
}

}  // namespace
}  // namespace dwell
