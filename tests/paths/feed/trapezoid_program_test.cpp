#include "paths/feed/trapezoid_program.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/motion/cubic_move.h"
#include "paths/feed/cubic_check.h"
#include "paths/feed/execution.h"
#include "tests/paths/feed/motion_oracle.h"

namespace dwell {
namespace {

using test::crooked_chain;

Machine resting_machine() {
  Machine machine;
  machine.path_acceleration = 20.0;
  machine.max_feed = 100.0;
  return machine;
}

/// A straight line in strokes of many feeds, so that most changes of speed are short.
Program straight_line() {
  Program program;
  for (int i = 0; i < 40; ++i) {
    const Point from{0.5 * i, 0.25 * i}, to{0.5 * (i + 1), 0.25 * (i + 1)};
    program.steps.push_back({from, to, distance(from, to) / (3.0 + 0.05 * std::sin(1.7 * i)), true});
  }
  program.steps.push_back({{20.0, 10.0}, {20.0, 10.0}, 0.5, true});
  program.steps.push_back({{20.0, 10.0}, {0.0, 12.0}, 0.0, false});
  program.steps.push_back({{0.0, 12.0}, {3.0, 12.5}, 1.0, true});
  program.fastest_feed = 50.0;
  return program;
}

TEST(TrapezoidProgram, TakesTheTimesOfTheExecutionInFewerSteps) {
  for (const Program& program : {Program{"", crooked_chain(4, 60, 0.5, 12.0)}, straight_line()}) {
    Machine machine = resting_machine();
    machine.corner_delay = 0.003;
    const TrapezoidProgram made = trapezoid_program(program, machine);
    const Execution run = execute(program, machine);
    ASSERT_EQ(made.seconds.size(), run.seconds.size());
    for (std::size_t i = 0; i < run.seconds.size(); ++i) EXPECT_NEAR(made.seconds[i], run.seconds[i], 1e-12) << i;
    EXPECT_LT(made.motion.steps.size(), run.motion.steps.size());
    EXPECT_NEAR(made.motion.total_seconds(), run.motion.total_seconds(), 1e-9);
    const auto faults = cubics_beyond_machine(made.motion, machine);
    EXPECT_TRUE(faults.empty()) << (faults.empty() ? "" : faults[0]);
    for (std::size_t i = 1; i < made.motion.steps.size(); ++i)
      EXPECT_EQ(made.motion.steps[i].start, made.motion.steps[i - 1].finish) << i;
  }
}

TEST(TrapezoidProgram, HasNoShortPiecesWhereThereIsRoom) {
  constexpr double kLeast = 0.02;
  const Program program = straight_line();
  const TrapezoidProgram made = trapezoid_program(program, resting_machine(), kLeast),
                         exact = trapezoid_program(program, resting_machine());
  const auto shortest = [](const Program& motion) {
    double least = INFINITY;
    for (const ProgramStep& step : motion.steps) least = std::min(least, step.seconds);
    return least;
  };
  EXPECT_LT(shortest(exact.motion), 0.1 * kLeast);
  EXPECT_GE(shortest(made.motion), kLeast * (1.0 - 1e-9));
  EXPECT_TRUE(cubics_beyond_machine(made.motion, resting_machine()).empty());
  for (std::size_t i = 0; i < made.seconds.size(); ++i)
    EXPECT_NEAR(made.seconds[i], exact.seconds[i], 0.02 * exact.seconds[i]) << i;
}

TEST(TrapezoidProgram, RefusesAMachineWhoseSpeedJumps) {
  EXPECT_THROW(trapezoid_program(straight_line(), Machine{}), InputError);
}

}  // namespace
}  // namespace dwell
