#pragma once

#include <vector>

#include "core/base/point.h"

namespace dwell {

/// A move along the cubic of time through two points with given velocities there (Hermite), as controllers run tables
/// of position, velocity and time. A straight move at constant acceleration is one.
struct CubicMove {
  Point start, finish;        // [mm]
  Point speed_in, speed_out;  // [mm/s]
  double seconds = 0.0;       // > 0

  Point place(double t) const;
  Point speed(double t) const;
  /// Linear in time: the largest of each axis is at one of the ends [mm/s^2].
  Point acceleration(double t) const;
};

/// The largest speed of each axis along a move [mm/s].
Point largest_speed(const CubicMove& move);
/// The largest acceleration of each axis along a move [mm/s^2].
Point largest_acceleration(const CubicMove& move);

/// Places at equal steps of time, the ends included, so close that between two of them the tool may count as running
/// straight at one speed: as many steps as `parts_from_rest` times the change of velocity against the largest speed.
std::vector<Point> places_on(const CubicMove& move, double parts_from_rest);

}  // namespace dwell
