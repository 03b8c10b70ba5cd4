#pragma once

#include "core/base/point.h"
#include "core/map/height_map.h"

namespace dwell {

/// What the samples of a removal function above a twentieth of its peak say of its place and size.
struct RemovalMoments {
  double peak = 0.0;                // [nm/s]
  double fwhm = 0.0;                // [mm]
  double edge = 0.0;                // radius of the disc of the area above a twentieth of the peak [mm]
  Point centre;                     // [mm]
  Point peak_at;                    // [mm]
  double major = 0.0, minor = 0.0;  // FWHM of the Gaussian of the same second moments [mm]
  double angle = 0.0;               // of its major axis [deg]
};

/// rates [nm/s], NaN read as 0. Throws InputError if they remove nothing. Cost O(samples).
RemovalMoments removal_moments(const HeightMap& rates);

}  // namespace dwell
