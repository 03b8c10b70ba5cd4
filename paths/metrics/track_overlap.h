#pragma once

#include <optional>
#include <vector>

#include "paths/metrics/ripple.h"

namespace dwell {

/// How even the sum of overlapping tracks is: Zha et al. 2020, section 3.2.
struct TrackOverlap {
  double overlap = 0.0;    // share of the diameter that two neighbouring tracks have in common (eq. 2)
  double pitch = 0.0;      // (1 - overlap) diameter [mm]
  double deviation = 0.0;  // of the sum of all tracks, each normalised by its highest value, over one period (eq. 3)
};

/// section: axis_profile (the tool at rest, as in the paper's table) or line_profile (the moving tool, which gives what
/// is left on the part). diameter of the removal function [mm], finite and > 0; overlap in 0 .. 0.99, else InputError.
/// Cost: that of periodic_sum.
TrackOverlap track_overlap(const TrackProfile& section, double diameter, double overlap);

/// The smallest deviation among the overlaps, the first of equal ones. Throws InputError if there is none.
TrackOverlap best_overlap(const TrackProfile& section, double diameter, const std::vector<double>& overlaps);

/// The pitch that `raster:pitch=auto` takes: the widest pitch such that it and every narrower one leave a ripple of at
/// most `most` of the removal (PVn), rounded down to three figures. A narrow dip of the ripple at a wider pitch does
/// not count, because a tool worn by a few per cent no longer has it. Pitches are tried from 1/50 of the diameter in
/// steps of 1 % up to the diameter, and the last step is halved down to 1e-4 of the pitch.
struct AutoPitch {
  RasterRipple ripple;  // at that pitch, of 1 nm of removal
  TrackOverlap track;   // likewise, of the line profile
};
/// line: of line_profile; most: PVn, 0 < most < 1, else InputError; also if 1/50 of the diameter leaves more than
/// that. Cost: about 400 times that of periodic_sum, 10 to 100 ms.
AutoPitch widest_pitch(const TrackProfile& line, double diameter, double most);

}  // namespace dwell
