#pragma once

#include <limits>
#include <vector>

#include "paths/feed/speed_change.h"

namespace dwell {

/// A straight move as a controller runs it: from one speed to another at constant acceleration, with a stretch at the
/// commanded feed between them if there is room. The ends must be within reach of each other: |out^2 - in^2| <= 2
/// acceleration length. Where the machine limits jerk, every change of speed is an S of SpeedChange, which begins and
/// ends within the move: between moves the acceleration is 0.
struct Trapezoid {
  double length;        // [mm], > 0
  double acceleration;  // [mm/s^2], > 0; may be infinite
  double speed_in;      // [mm/s], >= 0
  double speed_out;
  /// What the machine allows here, whatever the feed [mm/s]; at least the speeds at the ends but for rounding.
  double most = std::numeric_limits<double>::infinity();
  double jerk = std::numeric_limits<double>::infinity();  // [mm/s^3], > 0; may be infinite

  SpeedChange change() const { return {acceleration, jerk}; }
};

/// The highest speed that a move reaches if neither the feed nor `most` holds it back [mm/s].
double peak_speed(const Trapezoid& move);

/// Time of a move at a feed [s]. The feed counts as at least the speeds at the ends and at most the peak and
/// `most`. Infinite at a
/// feed of 0.
double time_at_feed(const Trapezoid& move, double feed);

/// The feed at which moves together take a time [s], or `most` where even that is too slow. They are the moves of one
/// stroke, which have one feed. Where it is below the speeds at the ends it is what schedule_constant goes on with, and
/// the moves take less than the time. Cost: a few passes over the moves.
double feed_for_time(const std::vector<Trapezoid>& moves, double seconds, double most);

/// A stretch of a move at constant acceleration, or at constant jerk.
struct MotionPiece {
  double length;  // [mm]
  double speed_in, speed_out;
  double jerk = 0.0;          // [mm/s^3]
  double jerk_seconds = 0.0;  // that a piece of constant jerk lasts

  double seconds() const;
  /// At its beginning [mm/s^2].
  double acceleration_in() const;
  double way(double seconds) const;    // since its beginning [mm]
  double speed(double seconds) const;  // at a time since its beginning [mm/s]
};

/// The pieces of a move at a feed, in order: acceleration, feed, deceleration; those without length left out. Under a
/// limit of jerk a change of speed is two or three pieces.
std::vector<MotionPiece> pieces_at_feed(const Trapezoid& move, double feed);

}  // namespace dwell
