#pragma once

#include <limits>

namespace dwell {

/// How a machine changes its speed: at most so fast, and with an acceleration that itself begins and ends at 0 and
/// changes at most so fast. Without a limit of jerk the acceleration is there at once.
struct SpeedChange {
  double acceleration;                                    // [mm/s^2], > 0; may be infinite
  double jerk = std::numeric_limits<double>::infinity();  // [mm/s^3], > 0; may be infinite

  bool limits_jerk() const { return jerk < std::numeric_limits<double>::infinity(); }
  /// The least time for a change of the speed [s], whatever its sign: d / a + a / j, or 2 sqrt(d / j) where it ends
  /// before the acceleration is reached.
  double seconds(double change) const;
  /// The way that goes by [mm]: the speed runs through its mean in the middle of the time.
  double length(double from, double to) const;
  /// The acceleration that is reached [mm/s^2].
  double peak(double change) const;
  /// The highest speed that is reached from one over a way [mm/s], and by the same the highest from which it can be
  /// slowed down to that. Cost O(1).
  double reached(double from, double length) const;
};

}  // namespace dwell
