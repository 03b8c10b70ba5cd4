#pragma once

#include <optional>

#include "runs/plan/dwell_options.h"
#include "runs/plan/dwell_plan.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"

namespace dwell {

/// The most by which the residual at the pitch of raster:pitch=auto may exceed that at half of it.
inline constexpr double kPitchCost = 0.02;

/// No raster of more dwell points is tried for raster:pitch=auto, but the first.
inline constexpr double kMostTriedPoints = 1.0e6;

/// Whether the spec leaves the pitch of a raster to be found.
bool pitch_is_searched(const PathSpec& spec);

/// A raster whose pitch was found.
struct SearchedRaster {
  LaidPath laid;
  /// Its plan, where that is known: the weights are given, or the time is over. Then options are the defaults for
  /// weights that were to be searched, and the limits say so.
  std::optional<DwellPlan> dwell;
};

/// Lays a raster on the part whose pitch is found: the widest whose ripple is small enough (widest_pitch), halved until
/// the plan leaves at most kPitchCost more than one of half the pitch (and half the step unless that is given), with
/// the same weights. From an eighth of the FWHM on, the plan of half the pitch has a smoothness that weighs as much
/// there as the given one does here: the same number weighs less on a finer raster, and what that gains is not gained
/// by the pitch. Differences that exact figures cannot tell (kProbeError) do not count. Weights that are themselves
/// searched are taken as their defaults for this. The notes of the path say what was compared. Throws as lay_path and
/// find_dwell do; where options.max_seconds are over after the first solve, the best raster so far is returned. Cost:
/// two solves, one more for every time the pitch is halved, and one for the comparison at equal smoothing.
SearchedRaster lay_searched_raster(const Part& part, const PathSpec& spec, Motion motion, const DwellOptions& options,
                                   const Progress& progress = {});

}  // namespace dwell
