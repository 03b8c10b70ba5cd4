#include "paths/metrics/tool_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "paths/feed/feed.h"
#include "tests/paths/domain/path_test_util.h"

namespace dwell {
namespace {

using test::message_of;

constexpr double kTurn = 2.0 * std::numbers::pi;

TEST(PlanetaryTool, ReachesBetweenTheDifferenceAndTheSumOfTheRadii) {
  PlanetaryTool tool;
  tool.revolution_rpm = 31.0;
  tool.spin_rpm = -17.0;
  double nearest = 1e9, farthest = 0.0;
  for (int k = 0; k < 40000; ++k) {
    const double t = 1e-3 * k, r = length(tool.offset(t));
    const double beta = -17.0 / 60.0 * kTurn * t;
    ASSERT_NEAR(r, std::sqrt(4.0 + 25.0 - 20.0 * std::cos(beta)), 1e-12);  // eq. 7
    nearest = std::min(nearest, r);
    farthest = std::max(farthest, r);
  }
  EXPECT_NEAR(nearest, 3.0, 1e-12);
  EXPECT_NEAR(farthest, 7.0, 1e-6);
}

TEST(PlanetaryTool, TurnsCounterClockwiseFromItsStart) {
  PlanetaryTool tool;
  tool.revolution_rpm = 60.0;
  tool.spin_rpm = 0.0;
  tool.spin_deg = 90.0;
  EXPECT_NEAR(tool.offset(0.0).x, 5.0, 1e-12);  // O2 at +x; A a quarter turn on from the side of O1: at -y of it
  EXPECT_NEAR(tool.offset(0.0).y, -2.0, 1e-12);
  EXPECT_NEAR(tool.offset(0.25).x, 2.0, 1e-12);
  EXPECT_NEAR(tool.offset(0.25).y, 5.0, 1e-12);
  tool.revolution_deg = 180.0;
  EXPECT_NEAR(tool.offset(0.0).x, -5.0, 1e-12);
}

TEST(PlanetaryTool, MovesAtTheSpeedOfItsTrack) {
  for (const auto& [revolution, spin] : {std::pair{60.0, 150.0}, {60.0, -60.0}, {-45.0, 100.0}, {20.0, 0.0}}) {
    PlanetaryTool tool;
    tool.revolution_rpm = revolution;
    tool.spin_rpm = spin;
    tool.revolution_deg = 20.0;
    tool.spin_deg = 77.0;
    for (const double t : {0.0, 0.13, 0.9, 2.2}) {
      const double h = 1e-6;
      EXPECT_NEAR(tool.speed(t), distance(tool.offset(t + h), tool.offset(t - h)) / (2.0 * h), 1e-6)
          << revolution << " " << spin << " " << t;
    }
  }
  PlanetaryTool level;  // at ratio -1 the tool does not turn: every point of it moves at w rho0
  level.revolution_rpm = 60.0;
  level.spin_rpm = -60.0;
  EXPECT_NEAR(level.speed(0.37), kTurn * 5.0, 1e-12);
  level.point_radius = 5.0;  // A on the axis O1 at the start
  EXPECT_NEAR(level.speed(0.0), kTurn * 5.0, 1e-12);
}

TEST(TextureTrack, IsATrochoidAlongALine) {
  PlanetaryTool tool;
  tool.revolution_radius = 3.0;
  tool.point_radius = 0.0;
  tool.revolution_rpm = 40.0;
  tool.spin_rpm = 0.0;
  const std::vector<Stroke> strokes{{{1, 2}, {2.5, 2}, {3, 2}}, {{3, 2}, {3, 2}, {7, 2}}};
  const TextureTrack track = texture_track(strokes, minimum_dwell(strokes, {0.0, 0.5}), tool, 0.01);
  ASSERT_EQ(track.points.size(), 1200u);  // 6 mm at 0.5 mm/s
  for (std::size_t k = 0; k < track.points.size(); ++k) {
    const double t = 0.01 * static_cast<double>(k), phi = 40.0 / 60.0 * kTurn * t;
    ASSERT_NEAR(track.points[k].x, 1.0 + 0.5 * t + 3.0 * std::cos(phi), 1e-9) << k;
    ASSERT_NEAR(track.points[k].y, 2.0 + 3.0 * std::sin(phi), 1e-9) << k;
  }
}

TEST(TextureTrack, TakesTheTimeOfEachStrokeAndTurnsOn) {
  PlanetaryTool tool;
  tool.spin_deg = 30.0;
  // A bent stroke of 3 + 4 mm in 2 s, a halt of 1 s, none, and one elsewhere.
  const std::vector<Stroke> strokes{
      {{0, 0}, {3, 0}, {3, 4}}, {{3, 4}, {3, 4}, {3, 4}}, {{5, 5}, {6, 5}, {7, 5}}, {{9, -1}, {9, -2}, {9, -3}}};
  Eigen::VectorXd times(4);
  times << 2.0, 1.0, 0.0, 4.0;
  const TextureTrack track = texture_track(strokes, times, tool, 0.01);
  ASSERT_EQ(track.points.size(), 700u);
  const auto axis = [&](int k) { return track.points[static_cast<std::size_t>(k)] - tool.offset(0.01 * k); };
  const auto expect_at = [&](int k, Point p) { EXPECT_LE(distance(axis(k), p), 1e-9) << k; };
  expect_at(0, {0, 0});
  expect_at(50, {1.75, 0});
  expect_at(100, {3, 0.5});
  expect_at(200, {3, 4});
  expect_at(299, {3, 4});
  expect_at(300, {9, -1});
  expect_at(500, {9, -2});
}

TEST(TextureTrack, OfAHaltClosesAfterAWholeNumberOfTurns) {
  PlanetaryTool tool;
  tool.revolution_rpm = 60.0;
  tool.spin_rpm = 90.0;  // in two seconds two revolutions and three spins
  const std::vector<Stroke> halt{{{4, -1}, {4, -1}, {4, -1}}};
  const TextureTrack track = texture_track(halt, Eigen::VectorXd::Constant(1, 4.0), tool, 0.005);
  for (std::size_t k = 0; k < 400; ++k) ASSERT_LE(distance(track.points[k], track.points[k + 400]), 1e-9);
  EXPECT_GT(distance(track.points[0], track.points[200]), 0.5);
  const auto [low, high] = std::minmax_element(track.points.begin(), track.points.end(), [](Point a, Point b) {
    return distance(a, {4, -1}) < distance(b, {4, -1});
  });
  EXPECT_NEAR(distance(*low, {4, -1}), 3.0, 1e-9);
  EXPECT_NEAR(distance(*high, {4, -1}), 7.0, 1e-3);
}

TEST(TextureTrack, RefusesWhatIsOutOfRange) {
  const std::vector<Stroke> line{{{0, 0}, {1, 0}, {2, 0}}};
  const Eigen::VectorXd time = Eigen::VectorXd::Constant(1, 3.0);
  const auto refused = [&](auto change, double step = 0.01, double seconds = 3.0) {
    PlanetaryTool tool;
    change(tool);
    return message_of([&] { texture_track(line, Eigen::VectorXd::Constant(1, seconds), tool, step); });
  };
  const auto nothing = [](PlanetaryTool&) {};
  EXPECT_EQ(refused([](PlanetaryTool& t) { t.point_radius = 7.0; }),
            "texture: point_radius = 7 mm; required >= 0 and <= tool_radius = 6.25 mm");
  EXPECT_EQ(refused([](PlanetaryTool& t) { t.revolution_radius = -1.0; }),
            "texture: revolution_radius = -1 mm; required finite and >= 0");
  EXPECT_EQ(refused([](PlanetaryTool& t) { t.tool_radius = test::kNaN; }),
            "texture: tool_radius = nan mm; required finite and > 0");
  EXPECT_EQ(refused([](PlanetaryTool& t) { t.spin_rpm = test::kInf; }), "texture: spin_rpm = inf; required finite");
  EXPECT_EQ(refused(nothing, 0.0), "texture: step = 0 s; required finite and > 0");
  EXPECT_NE(refused(nothing, 0.1).find("<= 0.0357143 s, an eighth of a turn"), std::string::npos);
  EXPECT_NE(refused(nothing, 0.01, 1e6).find("at most 50 million"), std::string::npos);
  EXPECT_NE(refused(nothing, 0.01, 1e308).find("at most 50 million"), std::string::npos);
  EXPECT_EQ(refused(nothing, 0.01, -1.0), "texture: time of stroke 1 = -1 s; required finite and >= 0");
  EXPECT_NE(refused(nothing, 0.01, test::kNaN).find("time of stroke 1"), std::string::npos);
  EXPECT_NE(message_of([&] { texture_track(line, Eigen::VectorXd::Zero(2), {}, 0.01); }).find("2 times for 1"),
            std::string::npos);
  EXPECT_EQ(texture_track(line, Eigen::VectorXd::Zero(1), {}, 0.01).points.size(), 0u);
}

TEST(TextureDensity, KeepsTheTimeAndItsPlace) {
  const Grid grid{11, 16, 0.5, 0.8, {-2.0, 1.0}};
  const TextureTrack track{{{-1.8, 3.2}, {2.35, 6.04}, {2.35, 6.04}, {100.0, 3.0}, {-2.4, 0.4}}, 0.25};
  const HeightMap density = texture_density(track, grid);
  double time = 0.0;
  Point moment;
  for (Index i = 0; i < grid.size(); ++i) {
    const double here = density.values[static_cast<std::size_t>(i)] * 0.5 * 0.8;
    time += here;
    moment = moment + here * grid.centre(i);
  }
  // The last point has 0.2 x 0.25 of its weight on the corner pixel, the one before it none.
  EXPECT_NEAR(time, 0.25 * (3.0 + 0.05), 1e-12);
  EXPECT_NEAR(moment.x, 0.25 * (-1.8 + 2.0 * 2.35 + 0.05 * -2.0), 1e-12);
  EXPECT_NEAR(moment.y, 0.25 * (3.2 + 2.0 * 6.04 + 0.05 * 1.0), 1e-12);
  EXPECT_NEAR(density.at(6, 8) * 0.4, 0.25 * 2.0 * 0.3 * 0.7, 1e-12);  // (2.0, 5.8), 0.7 and 0.3 pixels off
}

}  // namespace
}  // namespace dwell
