#pragma once

#include <limits>

#include "core/base/grid.h"
#include "core/base/progress.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// Which points of the path belong to a neighbouring track rather than to the track of the point itself.
struct SpacingOptions {
  Index skip = 1;       // this many points before and after it never count, >= 1
  double detour = 2.0;  // a point of the same piece counts if the path to it is at least this many times as long as its
                        // distance, >= 1
  /// A track farther away does not count [mm], > 0. It bounds the work: a point without a neighbouring track would
  /// otherwise cost a search of the whole path.
  double reach = std::numeric_limits<double>::infinity();
};

/// Distances from dwell points to the neighbouring track [mm].
struct PathSpacing {
  Index points = 0;  // that have one
  Index alone = 0;   // that have none (a single straight line); they enter nothing else
  double min = 0.0;
  double mean = 0.0;
  double deviation = 0.0;  // standard deviation, over `points`
  double max = 0.0;
};

/// For every dwell point the distance to the nearest dwell point of another track: one in another piece (between
/// lifts), or of the same piece if the path between them is `detour` times as long as they are apart, and in either
/// case not among the `skip` points before and after. On a raster whose step is no longer than its pitch, this is the
/// pitch, except for points of the outermost lines within half a pitch of a turn: the path leads from them to their
/// neighbours without a detour, so that the nearest point farther on counts.
///
/// Throws InputError if the path is not valid or an option is out of range. Memory O(n). Time about O(n log n (spacing
/// / step)^2), because a search looks at all nearer points of its own track.
PathSpacing path_spacing(const ToolPath& path, const SpacingOptions& options = {}, const Progress& progress = {});

}  // namespace dwell
