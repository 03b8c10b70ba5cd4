#include "paths/feed/lift_rests.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "paths/feed/constant_schedule.h"
#include "paths/feed/execution.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/least_dwell.h"
#include "paths/feed/linear_program.h"

namespace dwell {
namespace {

constexpr LiftTimes kTimes{0.3, 0.2, 0.07};

Machine lifting_machine() {
  Machine machine;
  machine.max_feed = 20.0;
  machine.path_acceleration = 50.0;
  machine.lift = kTimes;
  return machine;
}

/// Lifted before the first work, between two and after the last; one way down is a step of the program.
Program lifting_program() {
  return {"",
          {{{9, 9}, {0, 0}, 0.0, false},
           {{0, 0}, {3, 0}, 1.0, true},
           {{3, 0}, {3, 1}, 1.0, true},
           {{3, 1}, {5, 4}, 0.0, false},
           {{5, 4}, {5, 4}, 0.25, false},
           {{5, 4}, {5, 4}, 0.5, true},
           {{5, 4}, {0, 2}, 0.0, false},
           {{0, 2}, {-2, 2}, 1.0, true},
           {{-2, 2}, {-9, 9}, 0.0, false}}};
}

std::string shape_of(const std::vector<ProgramStep>& steps) {
  std::string shape;
  for (const ProgramStep& step : steps) {
    const char* rest = step.seconds == kTimes.lift     ? "up"
                       : step.seconds == kTimes.plunge ? "down"
                       : step.seconds == kTimes.settle ? "settle"
                                                       : "step";
    shape += std::string(shape.empty() ? "" : " ") + rest + (step.removes ? "!" : "");
  }
  return shape;
}

TEST(LiftRests, StandWhereTheToolGoesUpAndComesDown) {
  const Program program = with_lift_rests(lifting_program(), lifting_machine());
  EXPECT_EQ(shape_of(program.steps),
            "step down settle! step! step! up step step down settle! step! up step down settle! step! step");
  for (std::size_t i = 1; i < program.steps.size(); ++i) {
    EXPECT_EQ(program.steps[i].start, program.steps[i - 1].finish) << i;
  }
  const LiftTotals totals = lift_totals(lifting_program(), lifting_machine());
  EXPECT_EQ(totals.lifts, 2U);
  EXPECT_EQ(totals.plunges, 3U);
  EXPECT_DOUBLE_EQ(totals.lift, 0.6);
  EXPECT_DOUBLE_EQ(totals.plunge, 0.6);
  EXPECT_DOUBLE_EQ(totals.settle, 0.21);
  // A table begins with its first work, where the tool comes down as well.
  Program table = lifting_program();
  table.steps.erase(table.steps.begin());
  table.steps.pop_back();
  EXPECT_EQ(lift_totals(table, lifting_machine()).plunges, 3U);
  EXPECT_EQ(lift_totals(table, lifting_machine()).lifts, 2U);
  EXPECT_FALSE(lift_totals(table, Machine{}).any());
  EXPECT_EQ(lift_totals({}, lifting_machine()).plunges, 0U);
}

double working_seconds(const Program& program) {
  double sum = 0.0;
  for (const ProgramStep& step : program.steps) sum += step.removes ? step.seconds : 0.0;
  return sum;
}

TEST(LiftRests, AreTimeOfTheMotionAndSettlingRemoves) {
  Machine without = lifting_machine();
  without.lift = {};
  Program program = lifting_program();
  const Execution run = execute(program, lifting_machine()), plain = execute(program, without);
  EXPECT_NEAR(run.motion.total_seconds(), plain.motion.total_seconds() + 0.6 + 0.6 + 0.21, 1e-12);
  EXPECT_NEAR(working_seconds(run.motion), working_seconds(plain.motion) + 0.21, 1e-12);
  EXPECT_EQ(run.seconds, plain.seconds);
  EXPECT_NEAR(motion_nodes(program, lifting_machine()).back().seconds, run.motion.total_seconds(), 1e-9);
  // So they are for a program that says its speeds.
  for (ProgramStep& step : program.steps) {
    if (step.seconds == 0.0) step.seconds = 0.4;
    if (step.length() > 0.0) step.speeds = EndSpeeds{};
  }
  const Execution cubics = execute(program, lifting_machine());
  EXPECT_NEAR(cubics.motion.total_seconds(), program.total_seconds() + 0.6 + 0.6 + 0.21, 1e-12);
  EXPECT_NEAR(motion_nodes(program, lifting_machine()).back().seconds, cubics.motion.total_seconds(), 1e-9);
}

/// A path with a lift and a halt alone in the middle.
ToolPath lifting_path() {
  ToolPath path{"file", {{0, 0}, {1, 0}, {2, 0}, {4, 3}, {6, 1}, {7, 1}, {8, 1.5}}, {}};
  path.lifted = {1, 0, 0, 1, 1, 0, 0};
  return path;
}

/// The time at work of every stroke, from the steps of a motion: the rests at lifts belong to what comes next.
std::vector<double> seconds_by_order(const Program& motion, const StrokeMoves& moves, const Execution& run,
                                     const Machine& machine) {
  std::vector<double> seconds(static_cast<std::size_t>(moves.strokes), 0.0);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves.stroke[i] == StrokeMoves::kNoStroke) continue;
    const auto j = static_cast<std::size_t>(moves.stroke[i]);
    seconds[j] += run.seconds[i];
    if (i == 0 || !motion.steps[i - 1].removes) seconds[j] += machine.lift.settle;
  }
  return seconds;
}

TEST(LiftRests, LeaveEveryStrokeItsDwellBySlowerOrFasterFeeds) {
  const Machine machine = lifting_machine();
  const StrokeMoves moves = stroke_moves(lifting_path(), Motion::Moving);
  const KinematicPath path = kinematic_path(moves.steps, machine);
  const Eigen::VectorXd least = least_dwell(moves, path, machine);
  Eigen::VectorXd dwell = least;
  for (Index j = 0; j < dwell.size(); ++j) dwell[j] += 0.8 + 0.1 * static_cast<double>(j % 3);
  EXPECT_GE(least[3], machine.lift.settle);  // of the halt
  const ConstantSchedule schedule = schedule_constant(moves, path, machine, dwell);
  Program program{"", moves.steps};
  program.fastest_feed = machine.max_feed;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves.stroke[i] == StrokeMoves::kNoStroke) continue;
    const auto j = static_cast<std::size_t>(moves.stroke[i]);
    const double length = moves.steps[i].length();
    program.steps[i].seconds = length > 0.0 ? length / schedule.feed[j] : schedule.halt[j];
  }
  const Execution run = execute(program, machine);
  const std::vector<double> seconds = seconds_by_order(program, moves, run, machine);
  for (std::size_t j = 0; j < seconds.size(); ++j)
    EXPECT_NEAR(seconds[j], dwell[static_cast<Index>(j)], 1e-8 * seconds[j]) << j;
  EXPECT_NEAR(working_seconds(run.motion), dwell.sum(), 1e-8 * dwell.sum());
  // And so with speeds between nodes.
  const LinearSchedule linear = schedule_linear(moves, path, machine, dwell);
  const Execution cubics = execute(linear_program(moves, path, linear, machine), machine);
  EXPECT_NEAR(working_seconds(cubics.motion), linear.seconds.sum(), 1e-9);
  EXPECT_NEAR(linear.seconds[3], dwell[3], 1e-12);
}

TEST(LiftRests, KeepAHaltThatSettlingFills) {
  EXPECT_EQ(commanded_halt(2.0, 0.5), 1.5);
  EXPECT_EQ(commanded_halt(0.5, 0.5), 1e-6);
  EXPECT_EQ(commanded_halt(0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace dwell
