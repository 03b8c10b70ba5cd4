#pragma once

#include <optional>

#include "core/map/height_map.h"

namespace dwell {

/// The direction of a straight trench.
struct TrenchDirection {
  double degrees = 0.0;         // counter-clockwise from +x, above -90 to 90
  double standard_error = 0.0;  // [deg]
  double width = 0.0;           // of the box with the second moment of what is deep across it [mm]
  double length = 0.0;          // from the first to the last stretch that counts [mm]
};

/// The direction of the trench in a map of removed depth [nm, positive where the surface went down, its plane taken
/// off]. It begins with the main axis of the second moments of what is deeper than 30 % of the deepest. Then the
/// centroids across of stretches of half the trench's width are fitted by a straight line, which is turned to until it
/// lies still (five times at most); the error is that of the line's slope, from the scatter of the centroids about it.
/// Stretches that the map does not show whole, or with less than half the median volume, do not count. Nothing if there
/// are fewer than four, or if what is deep is not longer than it is wide: then the map does not show a direction. Cost
/// O(pixels).
std::optional<TrenchDirection> fit_trench_direction(const HeightMap& depth);

/// How far two directions are apart, 0 .. 90 [deg]: a track has no sense.
double angle_between_tracks(double a, double b);

/// By how much a given direction may differ from the fitted one [deg]: five standard errors, or, if that is more, 1
/// degree or what moves the ends of the trench by a twentieth of its width, whichever is less.
double direction_tolerance(const TrenchDirection& fitted);

}  // namespace dwell
