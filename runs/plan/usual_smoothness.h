#pragma once

#include "runs/plan/laid_path.h"
#include "runs/plan/part.h"

namespace dwell {

/// Waves of dwell along the path that are so many times as long as the tool's equivalent FWHM are held back by half.
inline constexpr double kHalfHeldWave = 1.125;

/// The weight of smoothness that belongs to a tool on a path: waves of dwell along the path that are kHalfHeldWave
/// times as long as the tool's equivalent FWHM are held back by half; longer ones, of which the tool makes use, are
/// hardly touched, and shorter ones, of which little would reach the part, are flattened. With the tool taken as the
/// Gaussian of its volume rate V and energy (sigma^2 = V^2 / (4 pi integral of b^2)), a wave of wave number k in the
/// dwell weighs V^2 exp(-sigma^2 k^2) / pixel area in the residual's sum of squares and alpha s^2 k^2 / rho in the
/// smoothness's, both per area, with s the mean distance of neighbours along the path and rho the dwell points per area
/// of the part. The two are equal at k = 2 pi / (kHalfHeldWave FWHM) if
///
///   alpha / |b|^2 = 4 pi sigma^4 rho exp(-u^2) / (s^2 u^2),   u = 2 pi sigma / (kHalfHeldWave FWHM).
///
/// It does not change with the scale of heights or rates or the pixels' pitch, and follows a finer path such that the
/// dwell per area stays the same. 0 for a path without neighbours. Cost: one pass over the path. The factor is the
/// least, in eighths, with which the dwell on a measured mirror is smoother than the published one
/// (docs/benchmarks.md).
double usual_smoothness(const Part& part, const LaidPath& laid);

/// Full width at half maximum of the Gaussian of the tool's volume rate and energy [mm].
double equivalent_fwhm(const Part& part);

}  // namespace dwell
