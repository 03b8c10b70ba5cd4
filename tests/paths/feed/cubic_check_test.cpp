#include "paths/feed/cubic_check.h"

#include <gtest/gtest.h>

#include <string>

#include "paths/feed/machine_check.h"

namespace dwell {
namespace {

/// From rest to 3 mm/s over 1.5 mm in 1 s (3 mm/s^2), on at that speed, and to rest, along (0.6, 0.8).
Program three_pieces() {
  const Point along{0.6, 0.8};
  Program program;
  program.steps = {
      {{1.0, 2.0}, Point{1.0, 2.0} + 1.5 * along, 1.0, true, EndSpeeds{{}, 3.0 * along}},
      {Point{1.0, 2.0} + 1.5 * along, Point{1.0, 2.0} + 4.5 * along, 1.0, true, EndSpeeds{3.0 * along, 3.0 * along}},
      {Point{1.0, 2.0} + 4.5 * along, Point{1.0, 2.0} + 6.0 * along, 1.0, false, EndSpeeds{3.0 * along, {}}}};
  return program;
}

Machine within_limits() {
  Machine machine;
  machine.x.max_speed = 1.8;
  machine.y.max_speed = 2.4;
  machine.max_feed = 3.0;
  machine.x.max_acceleration = 1.8;
  machine.y.max_acceleration = 2.4;
  machine.path_acceleration = 3.0;
  return machine;
}

TEST(CubicCheck, FindsNothingAtTheLimits) {
  EXPECT_TRUE(cubics_beyond_machine(three_pieces(), within_limits()).empty());
  EXPECT_TRUE(beyond_machine(three_pieces(), within_limits()).empty());
}

TEST(CubicCheck, FindsEveryLimitByItself) {
  const auto only = [](Machine machine, const std::string& what) {
    const auto faults = cubics_beyond_machine(three_pieces(), machine);
    ASSERT_EQ(faults.size(), 1U) << what;
    EXPECT_NE(faults[0].find(what), std::string::npos) << faults[0];
    EXPECT_EQ(beyond_machine(three_pieces(), machine), faults);
  };
  constexpr double kLess = 1.0 - 1e-5;
  Machine machine = within_limits();
  machine.x.max_speed *= kLess;
  only(machine, "3 steps of the program exceed the machine's speed of x: the first is step 1, the most 1.8 mm/s");
  machine = within_limits();
  machine.y.max_speed *= kLess;
  only(machine, "speed of y");
  machine = within_limits();
  machine.max_feed *= kLess;
  only(machine, "speed along the path");
  machine = within_limits();
  machine.x.max_acceleration *= kLess;
  only(machine, "2 steps of the program exceed the machine's acceleration of x");
  machine = within_limits();
  machine.y.max_acceleration *= kLess;
  only(machine, "acceleration of y");
  machine = within_limits();
  machine.path_acceleration *= kLess;
  only(machine, "acceleration along the path");
}

TEST(CubicCheck, FindsJumpsOfTheVelocity) {
  const auto jumps = [](const Program& program) {
    const auto faults = cubics_beyond_machine(program, Machine{});
    return faults.size() == 1 && faults[0].find("(a jump)") != std::string::npos;
  };
  Program program = three_pieces();
  EXPECT_FALSE(jumps(program));
  program.steps[1].speeds->in.x += 1e-4;
  EXPECT_TRUE(jumps(program));
  program = three_pieces();
  program.steps.erase(program.steps.begin());
  EXPECT_TRUE(jumps(program)) << "begins in motion";
  program = three_pieces();
  program.steps.pop_back();
  EXPECT_TRUE(jumps(program)) << "ends in motion";
}

TEST(CubicCheck, FindsTheSpeedInsideAStep) {
  // Both ends at rest: 2 mm in 1 s reach 3 mm/s in the middle, and 12 mm/s^2 at the ends.
  Program program;
  program.steps = {{{0.0, 0.0}, {2.0, 0.0}, 1.0, true, EndSpeeds{}}};
  Machine machine;
  machine.max_feed = 2.99;
  machine.path_acceleration = 11.99;
  EXPECT_EQ(cubics_beyond_machine(program, machine).size(), 2U);
  machine.max_feed = 3.0;
  machine.path_acceleration = 12.0;
  EXPECT_TRUE(cubics_beyond_machine(program, machine).empty());
}

TEST(CubicCheck, HoldsAccelerationsThatJumpToALimitOfJerk) {
  // Accelerations of 3 mm/s^2 that begin and end between pieces of 1 s.
  Machine machine = within_limits();
  machine.x.max_jerk = 1.8, machine.y.max_jerk = 2.4, machine.path_jerk = 3.0;
  EXPECT_TRUE(cubics_beyond_machine(three_pieces(), machine).empty());
  machine.y.max_jerk = 2.39;
  const auto faults = cubics_beyond_machine(three_pieces(), machine);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find("jerk of y"), std::string::npos) << faults[0];
  EXPECT_NE(faults[0].find("2.4 mm/s^3"), std::string::npos) << faults[0];
  machine = {};
  machine.path_jerk = 23.9;  // from rest to rest over 2 mm in 1 s: 12 mm/s^2, and within the cubic 24 mm/s^3
  Program program;
  program.steps = {{{0.0, 0.0}, {2.0, 0.0}, 1.0, true, EndSpeeds{}}};
  EXPECT_EQ(cubics_beyond_machine(program, machine).size(), 1U);
  machine.path_jerk = 24.0;
  EXPECT_TRUE(cubics_beyond_machine(program, machine).empty());
}

}  // namespace
}  // namespace dwell
