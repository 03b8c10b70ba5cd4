/// A machine whose axes lie otherwise than the part's does with a program what a machine with the part's axes does with
/// the same program in the machine's coordinates.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "paths/feed/execution.h"
#include "paths/feed/machine_check.h"
#include "tests/paths/feed/motion_oracle.h"

namespace dwell {
namespace {

/// x is quick and y is slow.
Machine uneven_machine() {
  Machine machine;
  machine.x = {-40.0, 3.0, 30.0, 200.0};
  machine.y = {-25.0, 30.0, 8.0, 30.0};
  machine.path_acceleration = 150.0;
  machine.max_feed = 25.0;
  machine.corner = CornerRule::JunctionDeviation;
  return machine;
}

Program crooked_program() {
  Program program;
  program.file = "part.nc";
  program.steps = test::crooked_chain(3, 40, 5.0, 40.0);
  return program;
}

Program in_coordinates_of(Program program, const ProgramFrame& frame) {
  for (ProgramStep& step : program.steps) {
    step.start = frame.to_program(step.start);
    step.finish = frame.to_program(step.finish);
  }
  return program;
}

TEST(MachineFrame, ExecutesAsTheProgramInItsCoordinates) {
  const Execution plain = execute(crooked_program(), uneven_machine());
  for (const ProgramFrame& frame : {ProgramFrame({3.5, -1.25}, 90.0, false), ProgramFrame({3.5, -1.25}, 0.0, true),
                                    ProgramFrame({-2.0, 7.0}, 37.0, true), ProgramFrame({0.0, 0.0}, 180.0, false)}) {
    Program framed = crooked_program();
    framed.frame = frame;
    Machine lying = uneven_machine();
    lying.frame = frame;
    const Execution expected = execute(in_coordinates_of(crooked_program(), frame), uneven_machine());
    for (const Execution& run : {execute(framed, uneven_machine()), execute(crooked_program(), lying)}) {
      ASSERT_EQ(run.seconds.size(), expected.seconds.size());
      for (std::size_t i = 0; i < run.seconds.size(); ++i) EXPECT_NEAR(run.seconds[i], expected.seconds[i], 1e-9) << i;
      EXPECT_NEAR(run.max_acceleration, expected.max_acceleration, 1e-6);
      EXPECT_NEAR(run.motion.total_seconds(), expected.motion.total_seconds(), 1e-9);
      const Point end = run.motion.steps.back().finish;  // of the part
      EXPECT_LE(distance(frame.to_program(end), expected.motion.steps.back().finish), 1e-9);
    }
    // Half a turn changes no axis's limits, a quarter does.
    const bool same = std::abs(expected.motion.total_seconds() - plain.motion.total_seconds()) < 1e-6;
    EXPECT_EQ(same, frame.degrees() == 180.0) << frame.degrees();
  }
}

TEST(MachineFrame, HasItsTravelInTheProgramsCoordinates) {
  Program program;
  program.steps = {{{0, 0}, {4, 0}, 10.0, true}, {{4, 0}, {4, 9}, 10.0, true}};
  Machine machine;
  machine.x = {-5.0, 5.0, 50.0, 500.0};
  machine.y = {-1.0, 20.0, 50.0, 500.0};
  EXPECT_TRUE(beyond_machine(program, machine).empty());
  program.frame = ProgramFrame({-2.0, 0.0}, 0.0, false);  // (4, 9) of the part is (6, 9)
  const std::vector<std::string> moved = beyond_machine(program, machine);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0],
            "2 steps of the program leave the machine's travel of x from -5 to 5 mm: the first is step 1, at x = 6 mm");
  program.frame = ProgramFrame({0.0, 0.0}, 0.0, true);  // (4, 9) is (9, 4)
  const std::vector<std::string> swapped = beyond_machine(program, machine);
  ASSERT_EQ(swapped.size(), 1u);
  EXPECT_EQ(swapped[0],
            "1 step of the program leaves the machine's travel of x from -5 to 5 mm: the first is step 2, at x = 9 mm");
}

}  // namespace
}  // namespace dwell
