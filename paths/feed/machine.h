#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "core/base/point.h"
#include "core/motion/axis_letters.h"
#include "core/motion/program.h"
#include "core/motion/program_frame.h"

namespace dwell {

/// What one axis of a machine can do.
struct MachineAxis {
  double lowest = -std::numeric_limits<double>::infinity();  // of its travel [mm]
  double highest = std::numeric_limits<double>::infinity();
  double max_speed = std::numeric_limits<double>::infinity();         // [mm/s], > 0
  double max_acceleration = std::numeric_limits<double>::infinity();  // [mm/s^2], > 0
  double max_jerk = std::numeric_limits<double>::infinity();          // [mm/s^3], > 0
};

/// How a machine takes the corner between two straight moves.
enum class CornerRule {
  ExactStop,          // it comes to rest there
  JunctionDeviation,  // at the speed of an arc that would leave the corner by junction_deviation
  Free,               // at any speed
  Blend,              // on an arc that leaves the first move before the corner and joins the second after it
};

/// How large a machine makes the arcs of CornerRule::Blend.
enum class BlendSize {
  Largest,   // as large as the tolerance and the lengths of the moves allow
  AsNeeded,  // no larger than the commanded feeds need
};

std::string_view to_string(CornerRule rule);
std::string_view to_string(BlendSize size);

/// How long a machine rests where the tool is lifted and lowered [s], >= 0, beside the ways up and down that a program
/// says itself: with the tool up when it is lifted and when it is lowered, and then with the tool down until it has
/// settled, which removes.
struct LiftTimes {
  double lift = 0.0, plunge = 0.0, settle = 0.0;

  bool operator==(const LiftTimes&) const = default;
};

/// What a controller makes of the numbers and lines of a program.
struct ControllerLimits {
  double max_blocks_per_s = std::numeric_limits<double>::infinity();  // > 0; one line after the other at work
  double time_resolution = 0.0;                                       // of its clock [s], >= 0; 0: as files have it
  double position_resolution = 0.0;                                   // of its places [mm], >= 0; 0 likewise

  /// Whether it holds less than files do.
  bool is_coarse() const { return time_resolution > 0.0 || position_resolution > 0.0; }
};

/// A machine with two axes in the part's plane, as far as its motion decides what is removed.
/// Infinite limits do not bind. A default machine has none and is what a plan without a machine takes for granted.
struct Machine {
  MachineAxis x{}, y{};
  double max_feed = std::numeric_limits<double>::infinity();           // along the path [mm/s], > 0
  double path_acceleration = std::numeric_limits<double>::infinity();  // along the path [mm/s^2], > 0
  double path_jerk = std::numeric_limits<double>::infinity();          // along the path [mm/s^3], > 0
  CornerRule corner = CornerRule::ExactStop;
  double junction_deviation = 0.01;  // [mm], > 0
  double blend_tolerance = 0.01;     // how far arcs of the rule Blend leave the corner [mm], > 0
  BlendSize blend_size = BlendSize::Largest;
  /// Of the acceleration that all directions have, what arcs use across the path and along it; both > 0.
  double across_share = 1.0, along_share = 1.0;
  double corner_delay = 0.0;  // at rest at each exact stop [s], >= 0
  double min_feed = 0.0;      // [mm/s], >= 0
  LiftTimes lift{};
  ControllerLimits controller{};
  AxisLetters letters{};
  /// How the machine's axes lie against the part's coordinates, in which paths and steps are: the limits of an axis,
  /// its travel too, are those of the program's coordinate of that name.
  ProgramFrame frame{};
};

/// The machine with its axes as the program's file has them; a program in the part's coordinates changes nothing.
Machine machine_on(Machine machine, const Program& program);

/// Highest speed [mm/s] along a direction of the part: every axis within its own, and the path within its own. `along`
/// need not have length 1; 0 has no limit but the path's.
double speed_limit(const Machine& machine, Point along);
/// The same for acceleration [mm/s^2] and for jerk [mm/s^3].
double acceleration_limit(const Machine& machine, Point along);
double jerk_limit(const Machine& machine, Point along);

/// The shortest time that a line of a program may take at work [s]: that of the controller's block rate and, since
/// times are rounded to it, its clock's resolution; 0 without a block rate.
double least_block_seconds(const Machine& machine);

/// The acceleration that the machine has in every direction [mm/s^2], and likewise the jerk [mm/s^3] and the speed
/// [mm/s].
double acceleration_everywhere(const Machine& machine);
double jerk_everywhere(const Machine& machine);
/// Whether the machine limits jerk in any direction.
bool limits_jerk(const Machine& machine);
double speed_everywhere(const Machine& machine);

/// Throws InputError naming the fields of the machine that contradict each other, with both values: a travel of no
/// length, a minimum feed above what an axis or the path can do, a clock slower than the block rate, one letter for two
/// axes; or the one that is out of range.
void validate(const Machine& machine);

}  // namespace dwell
