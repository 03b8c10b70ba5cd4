#pragma once

#include <vector>

#include "core/base/grid.h"
#include "core/base/progress.h"

namespace dwell {

/// A stretch of a raster line, in steps along it: first <= last.
struct LineRun {
  Index line = 0;
  Index first = 0;
  Index last = 0;
};

/// A run in the order of the path.
struct OrderedRun {
  Index run = 0;           // index into the runs
  bool backwards = false;  // from last to first
  bool lifted = false;     // the move to it is made lifted
};

/// Orders runs so that few moves between them are long: from the end of one to the nearest end on its own or a
/// neighbouring line within `link`, preferring to keep on in the present direction among equally near ones; else,
/// lifted, to the nearest end of any. Starts with the first run, forwards. Distances: `pitch` between lines, `step`
/// along them, `link` in the same unit; infinite: no move is lifted.
/// runs: ascending by line, then by first; disjoint. Cost O(runs log runs) where lifts are few; a lift looks at as many
/// lines as the nearest end is away.
std::vector<OrderedRun> order_runs(const std::vector<LineRun>& runs, double pitch, double step, double link,
                                   const Progress& progress = {});

}  // namespace dwell
