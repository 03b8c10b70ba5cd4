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

/// Orders runs so that few moves between them are long. From the end of a run it goes to the nearest end of another on
/// the same or a neighbouring line within `link`, and among equally near ends to one in the present direction. If there
/// is none, it goes lifted to the nearest end of any. It starts with the first run, forwards. Lines are `pitch` apart
/// and points on them `step`; `link` has the same unit, and with an infinite one no move is lifted. runs: ascending by
/// line, then by first; disjoint. Cost O(runs log runs) where lifts are few; a lift looks through the lines as far as
/// the nearest end.
std::vector<OrderedRun> order_runs(const std::vector<LineRun>& runs, double pitch, double step, double link,
                                   const Progress& progress = {});

}  // namespace dwell
