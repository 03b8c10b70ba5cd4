#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "paths/curves/centred_curve.h"
#include "paths/domain/path_distance.h"

namespace dwell {

struct SpiralOptions : CentredCurveOptions {};

/// From "spiral:pitch=MM,..."; throws InputError as SpecText does.
SpiralOptions parse_spiral_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> spiral_distances(const SpiralOptions& options);

/// Archimedean spiral rho = L theta / 2 pi of pitch L, which leaves the centre in direction +x, with dwell points at
/// equal arc lengths k * step, k = 0, 1, ... The arc length s(theta) = L / 4 pi (theta sqrt(1 + theta^2) + asinh theta)
/// (Lin et al. 2014, eq. 16) is inverted by Newton's method from the point before, to rounding.
///
/// Its points within the domain (CentredDomain) are the path, in order; a move that passes over points left out is
/// lifted. Consecutive points are no farther apart than the step unless lifted. Every valid pixel centre is within
/// pitch/2 of the spiral, at a place that is within step/2 of a dwell point along the spiral.
///
/// Throws InputError naming the option, its value and what is required; also if the turns between the nearest and the
/// farthest place of the part have more than 50 million points, including those outside. Cost O(pixels + points); long
/// stretches outside are skipped at once, because the distance to the part says how long they are.
ToolPath spiral_path(const HeightMap& map, const SpiralOptions& options, const Progress& progress = {});

}  // namespace dwell
