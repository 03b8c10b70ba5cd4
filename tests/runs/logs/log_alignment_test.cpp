#include "runs/logs/log_alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/errors.h"
#include "core/removal/simulate.h"
#include "core/tif/removal_function.h"
#include "paths/feed/execution.h"
#include "runs/logs/path_tracker.h"
#include "tests/runs/logs/made_up_log.h"

namespace dwell {
namespace {

using test::crooked_program;
using test::LogMaking;
using test::made_up_log;

Machine usual_machine() {
  Machine machine;
  machine.path_acceleration = 150.0;
  machine.corner_delay = 0.004;
  return machine;
}

std::string refusal(const MotionLog& log, const Program& program, double tolerance = kLogTolerance) {
  try {
    align_log(log, program, tolerance);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Compares the time between nodes with what execute() says of each step.
void expect_step_times(const Program& program, const AlignedLog& aligned, double each, double of_all) {
  const Execution run = execute(program, usual_machine());
  double mean = 0.0, total = 0.0;
  ASSERT_EQ(aligned.nodes.size(), program.steps.size() + 1);
  for (std::size_t i = 1; i + 1 < program.steps.size(); ++i) {
    EXPECT_NEAR(aligned.step_seconds(i), run.seconds[i], each) << i;
    mean += (aligned.step_seconds(i) - run.seconds[i]) / static_cast<double>(program.steps.size());
  }
  for (const double seconds : run.seconds) total += seconds;
  EXPECT_NEAR(mean, 0.0, of_all);
  EXPECT_NEAR(aligned.seconds(), total, 0.02);
}

TEST(LogAlignment, FindsTheTimeOfEveryNode) {
  const Program program = crooked_program(3, 300);
  const MotionLog log = made_up_log(program, usual_machine());
  const AlignedLog aligned = align_log(log, program);
  expect_step_times(program, aligned, 6e-4, 2e-5);
  EXPECT_LE(aligned.max_off, 1e-6);
  EXPECT_NEAR(aligned.begins(), 3.1234 + 0.3 + std::hypot(7.0, 4.0) / 13.0 + 0.2, 3e-3);
  EXPECT_GT(aligned.before, 1000u);
  EXPECT_GT(aligned.after, 1000u);
  EXPECT_EQ(aligned.before + aligned.within + aligned.after, log.size());
}

TEST(LogAlignment, BearsNoiseAndCoarseSampling) {
  const Program program = crooked_program(3, 300);
  LogMaking making;
  making.noise = 5e-4;
  expect_step_times(program, align_log(made_up_log(program, usual_machine(), making), program), 6e-3, 1e-4);
  making.noise = 0.0;
  making.period = 5e-3;
  expect_step_times(program, align_log(made_up_log(program, usual_machine(), making), program), 6e-3, 1e-4);
}

TEST(LogAlignment, FollowsAPathThatComesBackOnItself) {
  // There and back on one line, across it, and past its own beginning.
  Program program{"back.nc", {}};
  const std::vector<Point> places{{0, 0}, {5, 0}, {1, 0}, {1, 3}, {3, 3}, {3, -2}, {0, -2}, {0, 1}};
  for (std::size_t i = 1; i < places.size(); ++i)
    program.steps.push_back({places[i - 1], places[i], distance(places[i - 1], places[i]) / (2.0 + 0.5 * double(i))});
  expect_step_times(program, align_log(made_up_log(program, usual_machine()), program), 1.5e-3, 5e-4);
}

TEST(LogAlignment, SharesThePauseAtAHalt) {
  Program program = crooked_program(5, 20);
  const Point at = program.steps[9].finish;
  program.steps.insert(program.steps.begin() + 10, ProgramStep{at, at, 0.25, true});
  const AlignedLog aligned = align_log(made_up_log(program, usual_machine()), program);
  EXPECT_NEAR(aligned.step_seconds(10), 0.25, 1e-9);
  const Execution run = execute(program, usual_machine());
  EXPECT_NEAR(aligned.step_seconds(9), run.seconds[9], 1.5e-3);
  EXPECT_NEAR(aligned.step_seconds(11), run.seconds[11], 1.5e-3);
}

TEST(LogAlignment, RefusesALogOfAnotherPathByHowFarOffItIs) {
  const Program program = crooked_program(3, 60);
  const MotionLog other = made_up_log(crooked_program(4, 60), usual_machine());
  // Both begin at one place; the paths part in the first steps.
  const std::string part = refusal(other, program);
  EXPECT_NE(part.find("made-up.csv: no log of this path (`log tolerance` 0.1 mm): it leaves the path of crooked.nc in "
                      "step "),
            std::string::npos)
      << part;
  EXPECT_NE(part.find(" mm beside it"), std::string::npos) << part;
  MotionLog far = other;
  for (Point& p : far.places) p = p + Point{50.0, 0.0};
  EXPECT_NE(refusal(far, program).find(" mm to (-3, 1.5) mm, where the work of crooked.nc begins"), std::string::npos)
      << refusal(far, program);
  MotionLog cut = made_up_log(program, usual_machine());
  cut.seconds.resize(cut.size() / 2);
  cut.places.resize(cut.size());
  EXPECT_NE(refusal(cut, program).find("it ends in step "), std::string::npos) << refusal(cut, program);
  // One sample far off is none of another path.
  MotionLog stray = made_up_log(program, usual_machine());
  stray.places[stray.size() / 2].y += 0.5;
  EXPECT_EQ(refusal(stray, program), "");
  EXPECT_NEAR(align_log(stray, program).max_off, 0.5, 0.1);
}

TEST(LogAlignment, SaysWhichChangeOfItsAxesWouldFit) {
  const Program program = crooked_program(3, 60);
  const auto with = [&](double xx, double xy, double yx, double yy) {
    MotionLog log = made_up_log(program, usual_machine());
    for (Point& p : log.places) p = {xx * p.x + xy * p.y, yx * p.x + yy * p.y};
    return refusal(log, program);
  };
  const auto has = [](const std::string& text, const std::string& words) {
    EXPECT_NE(text.find("; with " + words + " it would fit"), std::string::npos) << text;
  };
  has(with(-1, 0, 0, 1), "x reversed");
  has(with(1, 0, 0, -1), "y reversed");
  has(with(0, 1, 1, 0), "x and y exchanged");
  has(with(1e3, 0, 0, 1e3), "places 1000 times smaller");
  has(with(1 / 25.4, 0, 0, 1 / 25.4), "places 25.4 times as large (inch)");
  // The inverse of a quarter turn is another one.
  has(with(0, -1, 1, 0), "x and y exchanged and y then reversed");
}

TEST(LogAlignment, RefusesAProgramThatRemovesNothing) {
  Program program = crooked_program(3, 10);
  const MotionLog log = made_up_log(program, usual_machine());
  for (ProgramStep& step : program.steps) step.removes = false;
  EXPECT_NE(refusal(log, program).find("no step removes anything"), std::string::npos);
  EXPECT_THROW(align_log(log, crooked_program(3, 10), 0.0), InputError);
}

/// The largest difference of two maps, against the largest value of the first.
double difference_of(const HeightMap& a, const HeightMap& b) {
  double most = 0.0, off = 0.0;
  for (std::size_t k = 0; k < a.values.size(); ++k) {
    most = std::max(most, a.values[k]);
    off = std::max(off, std::abs(a.values[k] - b.values[k]));
  }
  return off / most;
}

TEST(RecordedMotion, RemovesWhatTheExecutionRemoves) {
  const Program program = crooked_program(8, 40, 0.5, 8.0);
  const Machine machine = usual_machine();
  const MotionLog log = made_up_log(program, machine);
  const AlignedLog aligned = align_log(log, program);
  const RemovalFunction tool = gaussian_removal(1.0, 1.2, 3.0);
  HeightMap map(Grid{70, 90, 0.3, 0.25, {-6.0, -6.0}});
  for (double& z : map.values) z = 0.0;
  const RemovalKernel kernel = removal_kernel(tool, map.grid.pitch_x, map.grid.pitch_y);
  const HeightMap recorded = simulate(recorded_motion(log, aligned, program), map, kernel, 1);
  EXPECT_LE(difference_of(simulate(execute(program, machine).motion, map, kernel, 1), recorded), 2e-3);
  EXPECT_GE(difference_of(simulate(program, map, kernel, 1), recorded), 0.02);  // the commanded speeds are far off
}

TEST(RecordedMotion, LeavesOutLiftedMoves) {
  Program program = crooked_program(8, 30, 0.5, 8.0);
  for (std::size_t i = 11; i < 14; ++i) program.steps[i].removes = false;
  const Machine machine = usual_machine();
  const MotionLog log = made_up_log(program, machine);
  const AlignedLog aligned = align_log(log, program);
  double recorded = 0.0, expected = 0.0;
  for (const ProgramStep& step : recorded_motion(log, aligned, program).steps) recorded += step.seconds;
  const Execution run = execute(program, machine);
  for (std::size_t i = 0; i < program.steps.size(); ++i) expected += program.steps[i].removes ? run.seconds[i] : 0.0;
  EXPECT_NEAR(recorded, expected, 0.02);
  EXPECT_GT(run.seconds[11] + run.seconds[12] + run.seconds[13], 0.2);
}

}  // namespace
}  // namespace dwell
