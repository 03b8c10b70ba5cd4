#pragma once

#include <functional>

#include "core/tif/removal_function.h"

namespace dwell {

/// A section across the track of a tool: a value over the distance v from the line that the tool axis follows [mm],
/// positive to the left of the feed. Zero outside [low, high].
struct TrackProfile {
  std::function<double(double)> value;
  double low = 0.0;
  double high = 0.0;
};

/// What one pass along a straight line leaves: L(v) = integral of b(u, v) du along the feed [nm mm/s], so that a line
/// at the feed f [mm/s] removes L / f [nm], and the integral of L over v is the volume rate (Hou, Liao, Wang 2017, eq.
/// 2). angle_deg: direction of the feed, counter-clockwise from +x; finite.
///
/// gaussian: closed form, the cut at its radius included; disc: slope (R w + v^2 ln((R + w) / |v|)), w = sqrt(R^2 -
/// v^2) (Lin et al. 2014, eq. 5; no jump at the rim). Measured and model removal functions are the cubic spline through
/// their own samples: exact for feeds along x and y, else by quadrature at half a sample. Independent of any
/// map's pixels. Throws InputError if the angle is not finite. Cost: none but for the last; O(16 samples) there.
TrackProfile line_profile(const RemovalFunction& tif, double angle_deg);

/// Section through the tool at rest, across the same direction: b(0, v) [nm/s]. Errors as line_profile.
TrackProfile axis_profile(const RemovalFunction& tif, double angle_deg);

}  // namespace dwell
