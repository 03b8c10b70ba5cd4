#pragma once

#include <vector>

#include "core/base/point.h"
#include "core/base/progress.h"

namespace dwell {

/// Length [mm] of the shortest tree that joins all points (Euclidean minimum spanning tree). An open path is such a
/// tree, so no path through the points is shorter. 0 for one point; duplicates cost nothing.
///
/// Exact to rounding: Boruvka's rounds, each joining every component to its nearest point outside, found by exact
/// search in a tree of boxes that skips boxes lying wholly within the component; ties are broken by one total order of
/// the edges, so that rounds close no cycle (Boruvka 1926; by trees of boxes: March, Ram and Gray 2010, "Fast Euclidean
/// minimum spanning tree"). About O(n log^2 n) time, memory O(n).
///
/// Throws InputError if there is no point, more than 50 million, or one that is not finite (named, 1-based).
double spanning_tree_length(const std::vector<Point>& points, const Progress& progress = {});

}  // namespace dwell
