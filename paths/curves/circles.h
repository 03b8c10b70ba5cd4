#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "paths/curves/centred_curve.h"
#include "paths/domain/path_distance.h"

namespace dwell {

struct CirclesOptions : CentredCurveOptions {};

/// From "circles:pitch=MM,..."; throws InputError as SpecText does.
CirclesOptions parse_circles_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> circles_distances(const CirclesOptions& options);

/// Concentric circles of radii (i + 1/2) pitch, i = 0, 1, ..., from the inside out. So the length of a circle times the
/// pitch is the area of the ring of width pitch about it. Dwell points lie in the middles of equal arcs of a circle: at
/// least three arcs, otherwise as many as bring their length nearest to the step.
///
/// A circle wholly within the domain (CentredDomain) begins and ends on the ray from the centre in direction +x; the
/// move to the next circle crosses that ray in the same sense. Of a broken circle, the arcs within the domain are run
/// in its sense, beginning with the one whose start is nearest to the tool. A move to another arc or circle is made
/// with the tool down if its middle is inside and it is no longer than the pitch plus half an arc of either circle;
/// else it is lifted. Moves along a circle are no longer than 7/6 of the step. Every valid pixel centre is within
/// pitch/2 of a circle, at a place within half an arc of a dwell point.
///
/// Throws InputError naming the option, its value and what is required; also if the circles between the nearest and the
/// farthest place of the part have more than 50 million points, including those outside. Cost O(pixels + points).
ToolPath circles_path(const HeightMap& map, const CirclesOptions& options, const Progress& progress = {});

}  // namespace dwell
