#include "paths/lines/corner_rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/paths/curves/curve_test_util.h"

namespace dwell {
namespace {

using test::sharpest_stroke_corner;

ToolPath path_of(const std::vector<Point>& points, std::vector<char> lifted = {}) {
  if (lifted.empty()) {
    lifted.assign(points.size(), 0);
    lifted[0] = 1;
  }
  return {"file", points, lifted};
}

TEST(CornerRounding, PutsPointsOnTheArcOfARightAngle) {
  // Legs of 4 mm to the east and of 3 mm to the north, meeting at (14, -2).
  const ToolPath path = path_of({{10, -2}, {11, -2}, {12, -2}, {13, -2}, {14, -2}, {14, -1}, {14, 0}, {14, 1}});
  const ToolPath round = round_corners(path, 1.5);
  const Point centre{12.5, -0.5};
  // Kept: x = 10, 11, 12 (2.5 and 1.5 mm or more from the corner); then 4 points, 22.5 degrees apart; then y = 0 and 1.
  ASSERT_EQ(round.size(), 9u);
  EXPECT_EQ(round.points[2], (Point{12, -2}));
  for (int i = 0; i < 4; ++i) {
    const double angle = (-90.0 + 11.25 + 22.5 * i) * std::numbers::pi / 180.0;
    EXPECT_LE(
        distance(round.points[static_cast<std::size_t>(3 + i)], centre + 1.5 * Point{std::cos(angle), std::sin(angle)}),
        1e-12);
  }
  EXPECT_EQ(round.points[7], (Point{14, 0}));
  EXPECT_EQ(round.points[8], (Point{14, 1}));
  EXPECT_EQ(round.kind, "file");
  EXPECT_LE(sharpest_stroke_corner(round), 30.0 + 1e-9);
  EXPECT_EQ(round.notes, (std::vector<std::string>{"corners rounded with radius 1.5 mm: 1"}));
  // Turning right is the mirror image.
  ToolPath mirror = path;
  for (Point& p : mirror.points) p.y = -p.y;
  const ToolPath right = round_corners(mirror, 1.5);
  ASSERT_EQ(right.size(), round.size());
  for (std::size_t j = 0; j < round.size(); ++j) {
    EXPECT_LE(distance(right.points[j], {round.points[j].x, -round.points[j].y}), 1e-12);
  }
}

TEST(CornerRounding, KeepsTheSpacingOfTheLegsOnTheArc) {
  std::vector<Point> points;
  for (int i = 0; i <= 50; ++i) points.push_back({0.1 * i, 0.0});
  for (int i = 1; i <= 30; ++i) points.push_back({5.0, 0.1 * i});
  const ToolPath round = round_corners(path_of(points), 1.0);
  // An arc of 1.571 mm in 16 parts; 2 mm of legs, 19 points, replaced.
  EXPECT_EQ(round.size(), points.size() - 19 + 16);
  EXPECT_LE(test::longest_move_on_part(round), 0.11);
}

TEST(CornerRounding, TakesNoMoreThanHalfOfALeg) {
  // A square wave of legs of 1 mm: radius 0.5 at most.
  const ToolPath path = path_of({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 0}, {3, 0}});
  const ToolPath round = round_corners(path, 2.0);
  EXPECT_EQ(round.size(), 2u + 4u * 4u);
  EXPECT_EQ(round.notes[0], "corners rounded with radius 2 mm: 4, 4 of them with less for want of room (least 0.5 mm)");
  for (std::size_t j = 1; j <= 4; ++j) EXPECT_NEAR(distance(round.points[j], {0.5, 0.5}), 0.5, 1e-12);
  EXPECT_LE(sharpest_stroke_corner(round), 30.0 + 1e-9);
}

TEST(CornerRounding, RespectsLiftsEndsAndSmallCorners) {
  const double small = 14.0 * std::numbers::pi / 180.0;
  const std::vector<Point> points{{0, 0}, {2, 0}, {2, 3}, {5, 3}, {6, 3}, {6 + std::cos(small), 3 + std::sin(small)}};
  const ToolPath lifted = path_of(points, {1, 0, 1, 0, 0, 0});
  EXPECT_TRUE(test::same_bytes(round_corners(lifted, 0.5), lifted)) << "the corners at (2, 0) and (2, 3) are lifts";
  const ToolPath joined = round_corners(path_of(points), 0.5);
  EXPECT_EQ(joined.size(), points.size() + 6u);
  EXPECT_EQ(joined.points.front(), points.front());
  EXPECT_EQ(joined.points.back(), points.back());
  EXPECT_EQ(joined.lifted, (std::vector<char>{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(CornerRounding, KeepsTurnBacksAndHalts) {
  const ToolPath back = path_of({{0, 0}, {3, 0}, {0, 0.05}, {0, 2}});
  const ToolPath round = round_corners(back, 0.2);
  EXPECT_EQ(round.points[1], (Point{3, 0})) << "a corner of 179 degrees";
  EXPECT_NE(round.notes[0].find("turn-backs of more than 175 degrees kept: 1"), std::string::npos);
  const ToolPath halt = path_of({{0, 0}, {1, 0}, {1, 0}, {1, 1}});
  EXPECT_TRUE(test::same_bytes(round_corners(halt, 0.2), halt));
  EXPECT_TRUE(test::same_bytes(round_corners(back, 0.0), back));
}

TEST(CornerRounding, HoldsItsPromisesOnRandomPaths) {
  std::mt19937 random(11);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Point> points{{draw(-9, 9), draw(-9, 9)}};
    std::vector<char> lifted{1};
    double heading = 0.0;
    bool turned_back = false;
    for (int leg = 0; leg < 12; ++leg) {
      const double turn = draw(-std::numbers::pi, std::numbers::pi);
      heading += turn;
      const bool lift = leg > 0 && random() % 5 == 0;
      turned_back = turned_back || (leg > 0 && std::abs(turn) > 174.99 * std::numbers::pi / 180.0);
      const int steps = 1 + static_cast<int>(random() % 6);
      const double step = draw(0.05, 1.0);
      for (int k = 0; k < steps; ++k) {
        points.push_back(points.back() + step * Point{std::cos(heading), std::sin(heading)});
        lifted.push_back(lift && k == 0 ? 1 : 0);
      }
    }
    if (turned_back) continue;
    const ToolPath path = path_of(points, lifted);
    const double radius = draw(0.01, 2.0);
    const ToolPath round = round_corners(path, radius);
    ASSERT_NO_THROW(validate(round));
    EXPECT_LE(test::sharpest_corner(round), 30.0 + 1e-6) << trial;
    EXPECT_LE(test::longest_move_on_part(round), 1.5);
    EXPECT_EQ(std::count(round.lifted.begin(), round.lifted.end(), 1), std::count(lifted.begin(), lifted.end(), 1));
    EXPECT_LE(round.size(), 9 * path.size());
    // No point of the old path is farther from the new one than the radius, and none of the new from the old.
    for (const Point p : points) {
      double off = 1e9;
      for (std::size_t j = 1; j < round.size(); ++j) {
        off = std::min(off, round.lifted[j] ? distance(p, round.points[j])
                                            : test::distance_to_segment(p, round.points[j - 1], round.points[j]));
      }
      EXPECT_LE(off, radius * 1.05) << trial;
    }
    for (const Point p : round.points) {
      double off = 1e9;
      for (std::size_t j = 1; j < points.size(); ++j) {
        if (!lifted[j]) off = std::min(off, test::distance_to_segment(p, points[j - 1], points[j]));
        off = std::min({off, distance(p, points[j]), distance(p, points[j - 1])});
      }
      EXPECT_LE(off, 0.5 * radius + 1e-9) << trial;
    }
  }
}

TEST(CornerRounding, RefusesBadInput) {
  const ToolPath path = path_of({{0, 0}, {1, 0}, {1, 1}});
  EXPECT_EQ(test::message_of([&] { round_corners(path, -1.0); }), "file: corner = -1 mm; required finite and >= 0");
  EXPECT_EQ(test::message_of([&] { round_corners(path, test::kNaN); }),
            "file: corner = nan mm; required finite and >= 0");
  EXPECT_NE(test::message_of([&] { round_corners(path_of({{0, 0}, {test::kInf, 0}}), 1.0); }), "");
}

}  // namespace
}  // namespace dwell
