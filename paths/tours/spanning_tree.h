#pragma once

#include <vector>

#include "core/base/point.h"
#include "core/base/progress.h"

namespace dwell {

/// Length [mm] of the shortest tree that joins all points (Euclidean minimum spanning tree). An open path through the
/// points is a tree too, so none is shorter. 0 for one point; duplicates add no length.
///
/// Exact to rounding. In each of Boruvka's rounds, every component is joined to its nearest point outside, which an
/// exact search in a tree of boxes finds; boxes that lie wholly within the component are skipped. Ties are broken by
/// one total order of the edges, so that no round closes a cycle (Boruvka 1926; by trees of boxes: March, Ram and Gray
/// 2010, "Fast Euclidean minimum spanning tree"). About O(n log^2 n) time, memory O(n).
///
/// Throws InputError if there is no point, more than 50 million, or one that is not finite (named, 1-based).
double spanning_tree_length(const std::vector<Point>& points, const Progress& progress = {});

}  // namespace dwell
