/// Programs in the steps of a controller's clock and places, and with the letters of its axes.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/motion/cubic_move.h"
#include "paths/feed/cubic_check.h"
#include "paths/feed/plan_program.h"
#include "runs/plan/rounded_motion.h"
#include "runs/programs/gcode.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/pmac_program.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/program_reader.h"
#include "runs/programs/pvt_table.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/runs/programs/program_cases.h"
#include "tests/runs/programs/pvt_cases.h"

namespace dwell {
namespace {

using program_cases::expect_contains;
using program_cases::input_error;
using program_cases::replaced;
using pvt_cases::lifted_motion;
using pvt_cases::made_by;
using pvt_cases::slow_machine;
using test::TemporaryFolder;

Machine coarse_machine(double clock, double place) {
  Machine machine = slow_machine();
  machine.controller.time_resolution = clock;
  machine.controller.position_resolution = place;
  return machine;
}

/// Whether a number is a multiple of a step, within what files hold.
bool is_multiple(double value, double step, double held) {
  return std::abs(value - step * std::round(value / step)) <= held;
}

/// Where a motion is at a time.
Point place_at(const Program& motion, double t) {
  for (const ProgramStep& step : motion.steps) {
    if (t > step.seconds) {
      t -= step.seconds;
      continue;
    }
    if (!step.speeds) return step.start + (t / step.seconds) * (step.finish - step.start);
    const double s = t / step.seconds, T = step.seconds;  // Hermite's basis
    const double h00 = 1 - 3 * s * s + 2 * s * s * s, h10 = s - 2 * s * s + s * s * s, h11 = s * s * s - s * s;
    return h00 * step.start + (T * h10) * step.speeds->in + (1 - h00) * step.finish + (T * h11) * step.speeds->out;
  }
  return motion.steps.back().finish;
}

TEST(ControllerSteps, AreThoseOfEveryNumberAndDoNotAddUp) {
  const Program motion = lifted_motion();
  for (const auto& [clock, place] : {std::pair{0.002, 1e-4}, std::pair{1e-4, 0.0}, std::pair{0.0, 0.0005}}) {
    const PvtTable table = pvt_table_of(motion, {}, {clock, place});
    double worst = 0.0;
    for (const PvtRow& row : table.rows) {
      if (clock > 0.0) {
        EXPECT_TRUE(is_multiple(row.seconds, clock, 1e-9)) << row.seconds;
      }
      if (place > 0.0) {
        EXPECT_TRUE(is_multiple(row.place.x, place, 1e-9) && is_multiple(row.place.y, place, 1e-9));
      }
      const Point there = place_at(motion, row.seconds);
      // At rest the tool stays where it stops; it is there up to half a step of the clock later.
      const double waits = row.speed == Point{} ? 0.5 * 20.0 * 0.25 * clock * clock : 0.0;
      worst = std::max(worst, std::max(std::abs(row.place.x - there.x), std::abs(row.place.y - there.y)) - waits);
    }
    EXPECT_LE(worst, 0.5 * place + 2e-6);
    EXPECT_NEAR(table.seconds(), motion.total_seconds(), 0.5 * clock + 1e-6);
    EXPECT_LE(table.rows.size(), motion.steps.size() + 1);
  }
}

TEST(ControllerSteps, AreInEveryFormatThatIsReadBack) {
  const Machine machine = coarse_machine(0.001, 0.0001);
  const Program motion = rounded_motion(lifted_motion(), machine);
  for (const ProgramFormat& format : program_formats()) {
    if (format.word.empty() || format.in_frame) continue;  // those of feeds hold no times
    const TemporaryFolder folder;
    ProgramWriting writing;
    writing.machine = machine;
    std::string first;
    for (const WrittenProgram& file : written_programs({made_by(), lifted_motion()}, writing, {format.word})) {
      if (file.word != format.word) continue;
      folder.file(file.file, file.bytes);
      if (first.empty()) first = file.file;
    }
    const Program read = read_program(folder.path() / first);
    // PMAC takes no step of more than 4.096 s.
    const PvtTable table = pvt_table_of(lifted_motion(), {}, pvt_steps_of(machine));
    const Program cut = program_of(with_steps_of_at_most(4.095, table), "");
    EXPECT_TRUE(same_removing_steps(read, format.word == "pmac" ? cut : motion, 20.0)) << format.word;
  }
}

TEST(ControllerSteps, LeaveTheLimitsOfTheMachineInTheFile) {
  const FeedTable table = made_by();
  const Eigen::VectorXd seconds =
      Eigen::Map<const Eigen::VectorXd>(table.dwell_s.data(), static_cast<Index>(table.dwell_s.size()));
  for (const auto& [clock, place] : {std::pair{0.001, 1e-4}, std::pair{0.004, 0.001}, std::pair{0.0, 0.002}}) {
    const Machine machine = coarse_machine(clock, place);
    int tries = 0;
    const Program motion = motion_to_be_rounded(machine, [&](double share) {
      ++tries;
      return exported_motion(table.path, Motion::Moving, machine, 20.0, seconds, {}, margins_of(share));
    });
    const std::vector<std::string> faults = cubics_beyond_machine(rounded_motion(motion, machine), machine);
    EXPECT_TRUE(faults.empty()) << clock << ", " << place << ": " << faults.front();
    EXPECT_LE(tries, 6);
  }
  // The motion for a controller without steps does not keep them.
  EXPECT_FALSE(
      cubics_beyond_machine(rounded_motion(lifted_motion(), coarse_machine(0.004, 0.001)), slow_machine()).empty());
}

TEST(ControllerSteps, LowerSpeedsWithAccelerations) {
  const Machine machine = slow_machine(), usual = with_margins(machine), low = with_margins(machine, margins_of(0.5));
  EXPECT_EQ(usual.max_feed, 0.999 * machine.max_feed);
  EXPECT_EQ(usual.path_acceleration, 0.995 * machine.path_acceleration);
  EXPECT_DOUBLE_EQ(low.max_feed, 0.9 * machine.max_feed);
  EXPECT_DOUBLE_EQ(low.y.max_acceleration, 0.5 * machine.y.max_acceleration);
}

Program halting_program() {
  Program program =
      program_of(program_cases::winding_path(), program_cases::winding_dwells(Motion::Stop), Motion::Stop, 50.0);
  return program;
}

TEST(ControllerSteps, AreThoseOfGcode) {
  GcodeOptions options;
  options.max_feed_mm_per_min = program_cases::kMaxFeedPerMin;
  options.machine = Machine{};
  options.machine->controller = {INFINITY, 0.01, 0.002};
  const Program program = halting_program();
  const Program read = read_gcode(gcode_text(program, options), "f", {});
  double wanted = 0.0, written = 0.0;
  for (const ProgramStep& step : program.steps) wanted += step.removes && step.length() == 0.0 ? step.seconds : 0.0;
  for (const ProgramStep& step : read.steps) {
    EXPECT_TRUE(is_multiple(step.finish.x, 0.002, 1e-9) && is_multiple(step.finish.y, 0.002, 1e-9));
    if (!step.removes || step.length() > 0.0) continue;
    EXPECT_TRUE(is_multiple(step.seconds, 0.01, 1e-9)) << step.seconds;
    written += step.seconds;
  }
  EXPECT_GT(wanted, 0.0);
  EXPECT_NEAR(written, wanted, 0.005 + 1e-9);
}

TEST(ControllerSteps, KeepTheSpeedsOfTheAxesOnRoundedMoves) {
  GcodeOptions options;
  options.max_feed_mm_per_min = program_cases::kMaxFeedPerMin;
  options.machine = Machine{};
  options.machine->x.max_speed = 7.0;
  options.machine->controller.position_resolution = 0.1;
  Program program{"", {}};
  for (int k = 0; k < 9; ++k) {  // as fast as x can
    const double x = 0.53 * k;
    program.steps.push_back({{x, 0.0}, {x + 0.53, 0.0}, 0.53 / 7.0, true});
  }
  for (const ProgramStep& step : read_gcode(gcode_text(program, options), "f", {}).steps) {
    if (step.removes) {
      EXPECT_LE(step.length() / step.seconds, 7.0 * (1.0 + 1e-9));
    }
  }
}

TEST(AxisLetters, AreThoseOfGcodeWrittenAndRead) {
  GcodeOptions options;
  options.max_feed_mm_per_min = program_cases::kMaxFeedPerMin;
  const Program program = halting_program();
  const std::string plain = gcode_text(program, options);
  options.machine = Machine{};
  options.machine->letters = {'U', 'A'};
  const std::string text = gcode_text(program, options);
  EXPECT_NE(text.find("units: U A Z mm"), std::string::npos);
  EXPECT_EQ(text.find('X'), std::string::npos);
  EXPECT_EQ(text.find('Y'), std::string::npos);
  GcodeReading reading;
  reading.letters = {'U', 'A'};
  const Program read = read_gcode(text, "f", reading);
  EXPECT_TRUE(same_removing_steps(read, read_gcode(plain, "f", {}), 50.0));
  expect_contains(input_error([&] { read_gcode(plain, "f.nc", reading); }),
                  "X is no axis of the machine, whose letters are U and A (letter of [x] and [y] in its file)");
  expect_contains(input_error([&] { read_gcode(text, "f.nc", {}); }),
                  "if an axis of the part's plane is called so, a `machine` file that says its letter");
  reading.letters = {'V', 'A'};
  expect_contains(input_error([&] { read_gcode(text, "f.nc", reading); }),
                  "U is no axis of the machine, whose letters");
}

TEST(AxisLetters, AreThoseOfPmacWrittenAndRead) {
  const PvtTable table = pvt_table_of(lifted_motion());
  std::size_t end = 1;
  while (end + 1 < table.rows.size() && !table.rows[end + 1].lifted) ++end;
  const std::string text = pmac_program_text(table, 0, end, made_by(), {'A', 'X'});
  const PvtTable read = parse_pmac_program(text, "f", {}, {}, {'A', 'X'});
  ASSERT_EQ(read.rows.size(), end + 1);
  EXPECT_EQ(read.rows[end].place, table.rows[end].place);
  expect_contains(input_error([&] {
                    parse_pmac_program(text, "f.pmc", {}, {}, {'U', 'V'});
                  }),
                  "A is no axis of the machine, whose letters are U and V");
}

}  // namespace
}  // namespace dwell
