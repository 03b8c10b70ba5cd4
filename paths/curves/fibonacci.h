#pragma once

#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/spec_text.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"
#include "paths/domain/path_distance.h"

namespace dwell {

struct FibonacciOptions {
  double pitch = 0.0;             // one dwell point per pitch^2 [mm], finite and > 0; required
  std::optional<double> overrun;  // how far dwell points lie beyond the valid pixels [mm], finite and >= 0; default 0
                                  // (plan_path: TIF radius)
  std::optional<Point> centre;    // [mm], finite; default: middle of the box of the valid pixel centres
};

/// From "fibonacci:pitch=MM,..."; throws InputError as SpecText does.
FibonacciOptions parse_fibonacci_options(const SpecText& spec);

/// The distances of tracks and dwell points that these options ask for.
std::vector<PathDistance> fibonacci_distances(const FibonacciOptions& options);

/// Phyllotaxis lattice: point k = 0, 1, ... at distance pitch sqrt((k + 1/2) / pi) from the centre and angle k times
/// the golden angle, 137.5 degrees counter-clockwise from +x (Vogel 1979, "A better way to construct the sunflower
/// head", Mathematical Biosciences 44). It has one point per pitch^2 everywhere and no direction of its own. Neighbours
/// are 0.87 to 1.16 pitch apart; every place is within 0.78 pitch of a point, or within 0.71 pitch farther than three
/// pitches from the centre.
///
/// A point is wanted if it lies within max(overrun, 0.78 pitch, half of a pixel's diagonal) of a valid pixel centre. So
/// every valid pixel centre is as near to a wanted point as any place is to a point of the lattice.
///
/// Order: about the centre, ring by ring, along the spiral arms that are closest at that distance. With F of a ring the
/// Fibonacci number for which k / F^2 is 0.11 to 0.29, points k, k + F, k + 2F, ... are an arm, whose points are 0.94
/// to 1.0 pitch apart; arms follow each other outwards and inwards by turns. Where the edge or a hole cuts arms into
/// pieces, all pieces on one side of the cut are run before those on the other. Moves from arm to arm are lifted if
/// longer than 2.5 pitch, or if their middle is not within that distance of a valid pixel. A note says how long the
/// tour is.
///
/// Throws InputError naming the option, its value and what is required; also if there are more than 50 million points
/// between the nearest and the farthest place of the part, including those outside. Cost O(pixels + those points).
ToolPath fibonacci_path(const HeightMap& map, const FibonacciOptions& options, const Progress& progress = {});

}  // namespace dwell
