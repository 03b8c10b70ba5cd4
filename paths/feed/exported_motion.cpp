#include "paths/feed/exported_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "paths/feed/constant_schedule.h"
#include "paths/feed/kinematic_path.h"
#include "paths/feed/lift_rests.h"
#include "paths/feed/stroke_moves.h"
#include "paths/feed/trapezoid_program.h"

namespace dwell {
namespace {

constexpr double kRoundedPlace = 1.5;  // of a step of places: both ends, in both axes
constexpr double kLeastTicks = 4.0;    // of the clock, a piece
constexpr int kRounds = 3;             // of schedules

double least_acceleration(const Machine& machine) {
  return std::min({machine.path_acceleration, machine.x.max_acceleration, machine.y.max_acceleration});
}

/// The program that a schedule commands.
Program commanded(const StrokeMoves& moves, const ConstantSchedule& schedule, double max_feed) {
  Program program;
  program.fastest_feed = max_feed;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    ProgramStep step = moves.steps[i];
    const Index j = moves.stroke[i];
    if (j == StrokeMoves::kNoStroke) {
      if (step.removes) step.seconds = step.length() / max_feed;
    } else {
      const double feed = schedule.feed[static_cast<std::size_t>(j)];
      step.seconds =
          step.length() > 0.0 && feed > 0.0 ? step.length() / feed : schedule.halt[static_cast<std::size_t>(j)];
    }
    program.steps.push_back(step);
  }
  return program;
}

}  // namespace

double listed_corner_delay(const Machine& machine) {
  return machine.corner_delay > 0.0 ? std::max(machine.corner_delay, least_block_seconds(machine)) : 0.0;
}

void check_exported_motion(const Machine& machine, ScheduleKind schedule) {
  for (const Point along : {Point{1.0, 0.0}, Point{0.0, 1.0}}) {
    if (std::isfinite(acceleration_limit(machine, along))) continue;
    throw InputError(fmt::format(
        "`export`: the `machine` has no limit of acceleration along {}, and its speed then jumps, which no table of "
        "positions, velocities and times can say; required max_acceleration_mm_per_s2 of both axes, or "
        "path_acceleration_mm_per_s2",
        along.x > 0.0 ? "x" : "y"));
  }
  if (limits_jerk(machine)) {
    throw InputError(
        "`export`: the `machine` limits jerk (path_jerk_mm_per_s3 or max_jerk_mm_per_s3), and between the rows of "
        "tables of positions, velocities and times the acceleration jumps; required a machine without a limit of jerk, "
        "if its controller takes such tables as they are, or feeds (no `export`)");
  }
  if (machine.corner == CornerRule::Blend) {
    throw InputError(
        "`export`: the `machine` has the corner rule blend, whose arcs no table of positions, velocities and times is "
        "made for; required exact-stop");
  }
  if (machine.corner == CornerRule::ExactStop || schedule == ScheduleKind::Pvt) return;
  throw InputError(fmt::format(
      "`export`: the `machine` has the corner rule {}, by which its velocity jumps at corners, which no table of "
      "positions, velocities and times can say; required exact-stop, or `schedule` = pvt",
      to_string(machine.corner)));
}

RoundingMargins margins_of(double acceleration_share) {
  RoundingMargins margins;
  margins.acceleration = acceleration_share;
  margins.speed = std::min(margins.speed, 1.0 - 0.2 * (1.0 - acceleration_share));
  return margins;
}

Machine with_margins(const Machine& machine, const RoundingMargins& margins) {
  Machine tight = machine;
  for (MachineAxis* axis : {&tight.x, &tight.y}) {
    axis->max_acceleration *= margins.acceleration;
    axis->max_speed *= margins.speed;
  }
  tight.path_acceleration *= margins.acceleration;
  tight.max_feed *= margins.speed;
  return tight;
}

double least_piece_seconds(const Machine& machine, const RoundingMargins& margins) {
  // A place that is off by d changes the accelerations at the ends of a cubic of T by 6 d / T^2.
  const double margin = 0.5 * (1.0 - margins.acceleration) * least_acceleration(machine);
  const double place = std::max(margins.place, kRoundedPlace * machine.controller.position_resolution);
  return std::max({margins.least_piece, std::sqrt(6.0 * place / margin),
                   kLeastTicks * machine.controller.time_resolution, least_block_seconds(machine)});
}

Program exported_motion(const ToolPath& path, Motion motion, const Machine& machine, double max_feed,
                        const Eigen::VectorXd& seconds, const Progress& progress, const RoundingMargins& margins) {
  check_exported_motion(machine);
  Machine tight = with_margins(machine, margins);
  tight.corner_delay = listed_corner_delay(machine);
  const double least = least_piece_seconds(machine, margins), most = margins.speed * max_feed;
  const StrokeMoves moves = stroke_moves(path, motion);
  const KinematicPath kinematic = kinematic_path(moves.steps, tight, most);
  Eigen::VectorXd aimed = seconds;
  TrapezoidProgram made;
  for (int round = 0; round < kRounds; ++round) {
    progress.check();
    made = trapezoid_program(commanded(moves, schedule_constant(moves, kinematic, tight, aimed), most), tight, least);
    Eigen::VectorXd taken = settling_of_strokes(moves, tight);
    std::vector<char> moving(static_cast<std::size_t>(seconds.size()), 0);
    for (std::size_t i = 0; i < moves.size(); ++i) {
      if (moves.stroke[i] == StrokeMoves::kNoStroke) continue;
      taken[moves.stroke[i]] += made.seconds[i];
      if (moves.steps[i].length() > 0.0) moving[static_cast<std::size_t>(moves.stroke[i])] = 1;
    }
    for (Index j = 0; j < aimed.size(); ++j) {
      if (moving[static_cast<std::size_t>(j)] != 0) aimed[j] = std::max(0.0, aimed[j] + seconds[j] - taken[j]);
    }
  }
  std::erase_if(made.motion.steps,
                [](const ProgramStep& step) { return step.start == step.finish && !(step.seconds > 0.0); });
  return std::move(made.motion);
}

}  // namespace dwell
