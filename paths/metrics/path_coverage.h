#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/motion/tool_path.h"

namespace dwell {

struct PathCoverage {
  Index pixels = 0;   // valid pixels of the map
  Index covered = 0;  // of which the centre lies within the reach of the path
  double share() const { return static_cast<double>(covered) / static_cast<double>(pixels); }
};

/// How many valid (finite) pixels of a map have their centre within `reach` [mm] of the path's strokes (those of a
/// moving tool, so that nothing lies on a lifted move). Half the pitch of the path is the reach at which neighbouring
/// tracks meet. Centres exactly that far away are covered, whatever the rounding (1e-9 of the reach).
///
/// Throws InputError if the path is not valid, the map has no valid pixel, or the reach is not finite and >= 0. Cost
/// O(strokes + pixels under them, counted once for every stroke that covers them); memory O(pixels).
PathCoverage path_coverage(const ToolPath& path, const HeightMap& map, double reach, const Progress& progress = {});

}  // namespace dwell
