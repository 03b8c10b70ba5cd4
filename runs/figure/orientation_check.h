#pragma once

#include <string>

#include "core/base/progress.h"
#include "core/form/form_terms.h"
#include "core/map/height_map.h"

namespace dwell {

/// What the maps before and after a run say of how the part lay.
struct OrientationCheck {
  Point shift;              // of what was removed against where it was meant to be, to half a step [mm]
  double as_thought = 0.0;  // RMS of the measured removal that the predicted one does not explain, lying so [nm]
  double best = 0.0;        // the same for the turn or flip that explains most [nm]
  /// Not empty: the removal or the second map lies turned or flipped, in which way, and what to do.
  std::string fault;
};

/// A turn or flip must leave less than this share of what is left without it to be believed.
inline constexpr double kOrientationShare = 0.7;

/// Where what was removed is looked for.
struct OrientationReach {
  double shift = 0.0;  // each way in x and y [mm]
  double step = 0.0;   // between the places that are tried [mm], > 0
};

/// Whether a measured removal is better explained by a flip, a half or a quarter turn: of what was removed (the machine
/// lies otherwise than thought) or of the map after it (the instrument does). `before` [nm]; `removed`: before less
/// after, on the same grid; `after` on its own; `predicted`: removal on a grid that reaches beyond that of the part by
/// the reach. Each of the eight ways is fitted by rate and form terms at some 4000 pixels and set against the maps as
/// thought at the same pixels, with values that no removal makes held to what the others span. What was removed is
/// turned about the middle of the part and also shifted; a map is turned about its own middle, which is laid on that of
/// the part. Throws Interrupted. Cost: two splines through the maps, and for each way
/// 500 pixels a shift.
OrientationCheck check_orientation(const HeightMap& before, const HeightMap& after, const HeightMap& removed,
                                   const HeightMap& predicted, const FormTerms& form, const OrientationReach& reach,
                                   int threads, const Progress& progress = {});

}  // namespace dwell
