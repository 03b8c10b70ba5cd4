#include "core/motion/program_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dwell {
namespace {

constexpr Point kZero{12.5, -3.25};
constexpr Point kPlace{14.5, 1.75};  // (2, 5) from there

TEST(ProgramFrame, OfThePartChangesNothing) {
  const ProgramFrame frame;
  EXPECT_TRUE(frame.is_of_part());
  const Point odd{0.1 + 0.2, -1e-300};
  EXPECT_EQ(frame.to_program(odd), odd);
  EXPECT_EQ(frame.to_part(odd), odd);
  EXPECT_EQ(frame.direction_to_program(odd), odd);
}

// Seen from +z with x to the right and y up: a quarter counter-clockwise takes +x to +y.
TEST(ProgramFrame, TurnsByQuartersExactly) {
  const auto placed = [](double degrees, bool swapped) {
    return ProgramFrame(kZero, degrees, swapped).to_program(kPlace);
  };
  EXPECT_EQ(placed(0, false), (Point{2, 5}));
  EXPECT_EQ(placed(90, false), (Point{-5, 2}));
  EXPECT_EQ(placed(180, false), (Point{-2, -5}));
  EXPECT_EQ(placed(-180, false), (Point{-2, -5}));
  EXPECT_EQ(placed(270, false), (Point{5, -2}));
  EXPECT_EQ(placed(-90, false), (Point{5, -2}));
  EXPECT_EQ(placed(360, false), (Point{2, 5}));
  EXPECT_EQ(placed(0, true), (Point{5, 2}));
  EXPECT_EQ(placed(90, true), (Point{2, -5}));  // exchanged after the turn
}

TEST(ProgramFrame, IsUndoneByItself) {
  for (const double degrees : {0.0, 90.0, -90.0, 180.0, 270.0, 37.0, -211.5}) {
    for (const bool swapped : {false, true}) {
      const ProgramFrame frame(kZero, degrees, swapped);
      EXPECT_FALSE(frame.is_of_part());
      EXPECT_LE(distance(frame.to_part(frame.to_program(kPlace)), kPlace), 1e-14) << degrees << swapped;
      EXPECT_NEAR(distance(frame.to_program({0, 0}), frame.to_program(kPlace)), length(kPlace), 1e-12);
      EXPECT_EQ(frame.to_program(kZero), (Point{0, 0}));
    }
  }
}

TEST(ProgramFrame, FollowsItsFormula) {
  const double angle = 37.0 * std::numbers::pi / 180.0, dx = kPlace.x - kZero.x, dy = kPlace.y - kZero.y;
  const Point expected{dx * std::cos(angle) - dy * std::sin(angle), dx * std::sin(angle) + dy * std::cos(angle)};
  EXPECT_LE(distance(ProgramFrame(kZero, 37.0, false).to_program(kPlace), expected), 1e-14);
  EXPECT_LE(distance(ProgramFrame(kZero, 37.0, true).to_program(kPlace), {expected.y, expected.x}), 1e-14);
}

}  // namespace
}  // namespace dwell
