// What programs of positions, velocities and times remove, as read back, against a sum over places of the tool every
// 0.1 ms, and against the same plan as G-code, executed.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/removal/simulate.h"
#include "core/tif/removal_function.h"
#include "paths/feed/constant_schedule.h"
#include "paths/feed/cubic_check.h"
#include "paths/feed/execution.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/least_dwell.h"
#include "paths/feed/linear_program.h"
#include "paths/feed/linear_schedule.h"
#include "paths/feed/stroke_moves.h"
#include "paths/feed/trapezoid_program.h"
#include "runs/programs/gcode.h"
#include "runs/programs/gcode_reader.h"
#include "runs/programs/program_formats.h"
#include "runs/programs/program_reader.h"
#include "runs/programs/pvt_csv.h"
#include "runs/programs/pvt_table.h"
#include "tests/core/base/temporary_folder.h"
#include "tests/runs/programs/pvt_cases.h"

namespace dwell {
namespace {

using pvt_cases::lifted_motion;
using pvt_cases::made_by;
using pvt_cases::slow_machine;

const RemovalFunction kTool = gaussian_removal(1.0, 1.4, 3.2);

/// Without symmetry, unequal pitches, an origin off zero, a corner missing.
HeightMap crooked_map() {
  HeightMap map(Grid{26, 31, 0.25, 0.2, {-3.3, -3.1}});
  for (Index i = 0; i < map.grid.size(); ++i) {
    const Point p = map.grid.centre(i);
    map.values[static_cast<std::size_t>(i)] = 3.0 + std::sin(1.3 * p.x) * std::cos(0.7 * p.y + 0.3) + 0.2 * p.x * p.y;
  }
  for (Index i = 0; i < 7; ++i) map.values[static_cast<std::size_t>(i)] = std::nan("");
  return map;
}

HeightMap left_by(const Program& program) {
  const HeightMap map = crooked_map();
  return surface_after(map, simulate(program, map, removal_kernel(kTool, map.grid.pitch_x, map.grid.pitch_y), 1));
}

double rms(const HeightMap& map) {
  double sum = 0.0;
  int count = 0;
  for (const double z : map.values) {
    if (std::isfinite(z)) sum += z * z, ++count;
  }
  return std::sqrt(sum / count);
}

/// The removal of a table's text by its own reading and Hermite's basis, every 0.1 ms.
std::vector<double> stepped_removal(const std::string& csv, const HeightMap& map) {
  std::vector<double> removal(map.values.size(), 0.0);
  std::istringstream lines(csv);
  std::array<double, 6> before{};
  bool first = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 't') continue;
    std::array<double, 6> row{};
    std::istringstream fields(line);
    for (double& value : row) {
      std::string field;
      std::getline(fields, field, ',');
      value = std::stod(field);
    }
    if (!first && row[5] == 0.0) {
      const double seconds = row[0] - before[0];
      const int parts = static_cast<int>(std::ceil(seconds / 1e-4));
      for (int k = 0; k < parts; ++k) {
        const double s = (k + 0.5) / parts, r = 1.0 - s;
        const auto place = [&](std::size_t x) {
          return (1 + 2 * s) * r * r * before[x] + s * r * r * seconds * before[x + 1] + s * s * (3 - 2 * s) * row[x] -
                 s * s * r * seconds * row[x + 1];
        };
        const Point at{place(1), place(3)};
        for (std::size_t i = 0; i < removal.size(); ++i) {
          const Point d = map.grid.centre(static_cast<Index>(i)) - at;
          const double r2 = d.x * d.x + d.y * d.y;
          if (r2 < kTool.radius * kTool.radius)
            removal[i] += seconds / parts * std::exp(-0.5 * r2 / (kTool.sigma * kTool.sigma));
        }
      }
    }
    before = row;
    first = false;
  }
  return removal;
}

TEST(PvtRemoval, IsThatOfStepsOfTime) {
  const std::string csv = pvt_csv_text(pvt_table_of(lifted_motion()), made_by());
  const Program read = program_of(parse_pvt_csv(csv, "f"), "f");
  const HeightMap map = crooked_map(), left = left_by(read);
  const std::vector<double> expected = stepped_removal(csv, map);
  double most = 0.0, off = 0.0, even = 0.0;
  Program straight = read;  // what would be left if the speeds were not read
  for (ProgramStep& step : straight.steps) step.speeds.reset();
  const HeightMap without = left_by(straight);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!std::isfinite(map.values[i])) continue;
    most = std::max(most, expected[i]);
    off = std::max(off, std::abs(map.values[i] - left.values[i] - expected[i]));
    even = std::max(even, std::abs(map.values[i] - without.values[i] - expected[i]));
  }
  EXPECT_GT(most, 1.0);
  EXPECT_LE(off, 1e-3 * most);
  EXPECT_GE(even, 4e-3 * most);
}

TEST(PvtRemoval, LeavesWhatTheGcodeLeavesOnTheMachine) {
  const FeedTable table = made_by();
  GcodeOptions options;
  options.max_feed_mm_per_min = table.max_feed_mm_per_min;
  const Program gcode = read_gcode(gcode_text(program_of(table), options), "f", {});
  const HeightMap expected = left_by(execute(gcode, slow_machine()).motion);
  const Program motion = trapezoid_program(program_of(table), slow_machine()).motion;
  for (const ProgramFormat& format : program_formats()) {
    if (format.word.empty() || format.word == "flin") continue;
    const test::TemporaryFolder folder;
    for (const WrittenProgram& file : written_programs({table, motion}, {}, {format.word}))
      folder.file(file.file, file.bytes);
    const HeightMap left = left_by(read_program(folder.path() / format.file));
    HeightMap change = left;
    for (std::size_t i = 0; i < change.values.size(); ++i) change.values[i] -= expected.values[i];
    EXPECT_NEAR(rms(left), rms(expected), 1e-6 * rms(expected)) << format.word;
    EXPECT_LE(rms(change), 5e-6 * rms(expected)) << format.word;
  }
}

/// A path that turns and runs straight, lifts now and then, with dwells that a machine can hold, for a seed.
struct RandomPlan {
  ToolPath path{"file", {}, {}};
  Machine machine;
  double max_feed = 0.0;
  Eigen::VectorXd seconds;

  explicit RandomPlan(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Point at{3.0 * unit(random), -unit(random)};
    double heading = 6.28 * unit(random);
    const double turns = unit(random), pitch = 0.2 + unit(random);
    for (int i = 0; i < 60; ++i) {
      if (unit(random) < turns) heading += 3.0 * (unit(random) - 0.5);
      at = at + pitch * Point{std::cos(heading), std::sin(heading)};
      path.points.push_back(at);
      path.lifted.push_back(static_cast<char>(i == 0 || unit(random) < 0.05));
    }
    const double acceleration = std::pow(10.0, 0.5 + 2.5 * unit(random));
    machine.path_acceleration = acceleration;
    machine.x.max_acceleration = acceleration * (0.5 + unit(random));
    machine.y.max_acceleration = acceleration * (0.5 + unit(random));
    machine.max_feed = max_feed = 2.0 + 48.0 * unit(random);
    machine.x.max_speed = max_feed * (0.5 + unit(random));
    machine.corner_delay = unit(random) < 0.5 ? 0.0 : 0.002;
    const StrokeMoves moves = stroke_moves(path, Motion::Moving);
    const Eigen::VectorXd least = least_dwell(moves, kinematic_path(moves.steps, machine, max_feed), machine);
    seconds = Eigen::VectorXd(moves.strokes);
    for (Index j = 0; j < moves.strokes; ++j) seconds[j] = 0.05 + least[j] * (1.0 + 2.0 * unit(random));
    const KinematicPath kinematic = kinematic_path(moves.steps, machine, max_feed);
    seconds = schedule_constant(moves, kinematic, machine, seconds).seconds;  // as the machine runs them
  }
};

TEST(PvtRemoval, NoRandomPlanLeavesTheLimitsInItsFile) {
  double worst = 0.0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const RandomPlan plan(seed);
    const Program motion = exported_motion(plan.path, Motion::Moving, plan.machine, plan.max_feed, plan.seconds);
    FeedTable made = made_by();
    const std::string csv = pvt_csv_text(pvt_table_of(motion), made);
    const Program read = program_of(parse_pvt_csv(csv, "f"), "f");
    const auto faults = cubics_beyond_machine(read, plan.machine);
    EXPECT_TRUE(faults.empty()) << "seed " << seed << ": " << (faults.empty() ? "" : faults[0]);
    double removing = 0.0;
    for (const ProgramStep& step : read.steps) removing += step.removes ? step.seconds : 0.0;
    worst = std::max(worst, std::abs(removing / plan.seconds.sum() - 1.0));
  }
  EXPECT_LE(worst, 2e-3);
}

TEST(PvtRemoval, NoRandomScheduleOfSpeedsLeavesTheLimitsInItsFile) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const RandomPlan plan(seed);
    const Machine tight = with_margins(plan.machine);
    const StrokeMoves moves = stroke_moves(plan.path, Motion::Moving);
    const KinematicPath kinematic = kinematic_path(moves.steps, tight, plan.max_feed);
    const LinearSchedule schedule = schedule_linear(moves, kinematic, tight, plan.seconds);
    for (const bool joined : {false, true}) {
      Program motion = linear_program(moves, kinematic, schedule, tight, least_piece_seconds(plan.machine));
      if (joined) join_velocities(motion);
      FeedTable made = made_by();
      const Program read = program_of(parse_pvt_csv(pvt_csv_text(pvt_table_of(motion), made), "f"), "f");
      const auto faults = cubics_beyond_machine(read, plan.machine);
      EXPECT_TRUE(faults.empty()) << "seed " << seed << ": " << (faults.empty() ? "" : faults[0]);
    }
  }
}

}  // namespace
}  // namespace dwell
