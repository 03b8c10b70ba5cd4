#pragma once

#include <optional>
#include <vector>

#include "core/map/height_map.h"
#include "core/numerics/abel_inversion.h"
#include "core/tif/calibration/trench_direction.h"

namespace dwell {

struct TrenchOptions {
  double feed = 0.0;                // speed of the tool along the track [mm/s], finite and > 0
  std::optional<double> direction;  // of the track [deg], counter-clockwise from +x; default: fitted
  std::optional<double> radius;     // of the tool's removal [mm]; default 2.25 times as far as 30 % of the depth
  double noise_cut = 0.0;           // share of the peak below which a rate is set to 0, 0 .. 0.5
};

/// A rotationally symmetric removal function measured as a straight trench cut at constant feed.
struct TrenchCalibration {
  HeightMap rates;                    // [nm/s], origin relative to the tool axis; radially symmetric by construction
  RadialProfile profile;              // the rate over the radius [nm/s]
  std::vector<LineIntegral> section;  // cross-section times feed [nm mm/s] over the distance from the middle [mm]
  double radius = 0.0;                // [mm]
  double middle = 0.0;                // of the trench across its direction, from the origin of the coordinates [mm]
  double from = 0.0, to = 0.0;        // the stretch along the direction that was averaged [mm]
  double depth = 0.0;                 // of the cross-section [nm]
  double scatter = 0.0;               // of the pixels about the mean cross-section beyond the radius [nm]
  double direction = 0.0;             // that was taken [deg]
  std::optional<TrenchDirection> fitted;  // what the map says of it; nothing if it does not show one
  /// RMS of the odd part of the sections of both halves of the stretch, about the middle of the whole, over that of the
  /// even part: a skew tool and a wrong direction both show.
  double asymmetry = 0.0;
};

/// The removal function from the removed depth [nm] of a trench. Its direction is fitted (trench_direction.h); a given
/// one that disagrees by more than direction_tolerance is refused, since a wrong one smears the section. The
/// cross-section is the mean over the stretch of the track where the volume per length is within 5 % of its median
/// (which leaves out ends), less the line through its surroundings. Moved at speed f along u, the tool takes
///   depth(v) = (1 / f) integral of b(u, v) du,
/// so that depth times feed is the Abel transform of b (Lin et al. 2014, eq. 2-5 for a straight line), inverted by
/// abel_inversion. One trench does not show whether the tool is rotationally symmetric: `asymmetry` says how far from
/// symmetric the section is across the track, and nothing about the direction along it. Throws InputError naming option
/// or finding. Cost O(pixels).
TrenchCalibration calibrate_trench(const HeightMap& depth, const TrenchOptions& options);

}  // namespace dwell
