#pragma once

#include <Eigen/Core>

#include "core/base/progress.h"
#include "core/motion/motion.h"
#include "core/motion/program.h"
#include "core/motion/tool_path.h"
#include "paths/feed/machine.h"
#include "paths/feed/schedule_kind.h"

namespace dwell {

/// The rest at a corner as a line of a table of positions, velocities and times: no shorter than the controller's
/// blocks; 0 if there is none [s].
double listed_corner_delay(const Machine& machine);

/// What a table of positions, velocities and times needs of a machine that runs plain feeds. Throws InputError naming
/// `export`, the field of the machine and what is required: a limit of acceleration in every direction, and exact stops
/// at corners, since a velocity that jumps cannot be said.
/// A schedule of joined velocities (Pvt) takes any corner.
void check_exported_motion(const Machine& machine, ScheduleKind schedule = ScheduleKind::Constant);

/// The share of a machine's accelerations that is scheduled, so that the rounded numbers of files keep all of them.
inline constexpr double kAccelerationShare = 0.995;

/// What a schedule leaves to the rounding of its numbers.
struct RoundingMargins {
  double acceleration = kAccelerationShare;  // share of the machine's that is scheduled
  double speed = 0.999;                      // likewise
  double place = 1.5e-6;      // by how much a step is off for the rounding of both ends, in both axes [mm]
  double least_piece = 1e-3;  // [s]
};

/// The margins with such a share of the accelerations, and speeds lowered by a fifth as much.
RoundingMargins margins_of(double acceleration_share);

/// The machine with such shares of its accelerations and speeds, so that what is scheduled for it keeps the limits of
/// the machine itself after its numbers were rounded, without more said to 1e-6 mm and 1e-6 mm/s.
Machine with_margins(const Machine& machine, const RoundingMargins& margins = {});

/// The shortest piece of which rounding of its places, in the file's steps or the controller's, changes the
/// acceleration by no more than half of that margin, at least 1 ms, as controllers take such tables, four steps of the
/// controller's clock, and what its block rate asks for [s].
double least_piece_seconds(const Machine& machine, const RoundingMargins& margins = {});

/// The motion of a plan with one feed a stroke, as pieces of constant acceleration within the machine's margins: every
/// stroke takes the time that it has in the plan's own motion (`seconds`, one a stroke), so that it removes the same.
/// Feeds are made for these times (schedule_constant) and corrected twice for what short pieces change. Throws
/// InputError as check_exported_motion and trapezoid_program, Interrupted. Cost: three schedules.
Program exported_motion(const ToolPath& path, Motion motion, const Machine& machine, double max_feed,
                        const Eigen::VectorXd& seconds, const Progress& progress = {},
                        const RoundingMargins& margins = {});

}  // namespace dwell
