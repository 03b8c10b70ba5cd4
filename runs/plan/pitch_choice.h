#pragma once

#include "runs/plan/dwell_options.h"
#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"

namespace dwell {

/// The most by which the residual at the pitch of raster:pitch=auto may exceed that at half of it.
inline constexpr double kPitchCost = 0.02;

/// Whether the spec leaves the pitch of a raster to be found.
bool pitch_is_searched(const PathSpec& spec);

/// Lays a raster on the part whose pitch is found: the widest whose ripple is small enough (widest_pitch), halved until
/// the plan leaves at most kPitchCost more than one of half the pitch (and half the step unless that is given), or the
/// pitch is down to an eighth of the FWHM. Weights
/// that are themselves searched are taken as their defaults for this. The notes of the path say what both leave. Throws
/// as lay_path and find_dwell do. Cost: two solves, and one more for every time the pitch is halved.
LaidPath lay_searched_raster(const Part& part, const PathSpec& spec, Motion motion, const DwellOptions& options,
                             const Progress& progress = {});

}  // namespace dwell
