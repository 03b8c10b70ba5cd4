#pragma once

#include "paths/metrics/track_profile.h"

namespace dwell {

/// The ripple that parallel lines at one pitch and one feed leave far from their ends: a wave whose wavelength is the
/// pitch (Hou, Liao, Wang 2017, "Influencing factors of residual ripple errors", figures 6 and 7).
struct RasterRipple {
  double pitch = 0.0;  // between the lines = wavelength [mm]
  double depth = 0.0;  // mean removal [nm]
  double feed = 0.0;   // that gives it [mm/s], eq. 6: volume rate / (pitch depth)
  double pve = 0.0;    // peak to valley [nm]
  double pvn = 0.0;    // pve / depth (eq. 1); does not depend on the depth
  double rms = 0.0;    // about the mean [nm]
};

/// Mean, spread and root mean square about the mean of the sum of a profile over all multiples of `spacing`.
struct PeriodicSum {
  double mean = 0.0;
  double low = 0.0, high = 0.0;
  double deviation = 0.0;  // root mean square about the mean
};

/// sum_k profile(v - k spacing) over one period, at 512 positions, the lines and the middles between them among these:
/// for a symmetric removal function the extremes lie there and are exact, else they are good to 2e-5 of the ripple.
/// `what` begins the message of InputError, thrown unless spacing is finite and at least 1e-5 of the profile's width.
/// Cost: 512 times width / spacing values of the profile.
PeriodicSum periodic_sum(const TrackProfile& profile, double spacing, const char* what);

/// line: from line_profile, which holds the direction of the feed. pitch [mm], mean removal depth [nm], both finite and
/// > 0, else InputError. Nothing is sampled on a map, so the pitch may be a fraction of a pixel. Cost: that of
/// periodic_sum.
RasterRipple raster_ripple(const TrackProfile& line, double pitch, double depth);

}  // namespace dwell
