#pragma once

#include "core/base/progress.h"
#include "core/motion/tool_path.h"

namespace dwell {

/// Corners up to this are left as they are [degrees].
inline constexpr double kLeftCornerDeg = 15.0;
/// Corners beyond this are turn-backs, which no arc can round without leaving the path; they are kept [degrees].
inline constexpr double kTurnBackDeg = 175.0;
/// An arc turns by no more than this at a dwell point [degrees].
inline constexpr double kArcTurnDeg = 24.0;

/// The path with its corners of more than kLeftCornerDeg replaced by arcs of `radius` [mm].
///
/// An arc touches both legs of its corner, which are the straight stretches up to the next bend (1e-6 rad) or the end
/// of the piece. It takes at most half of each leg, and never departs from the corner by more than the radius: where
/// that is too little room (short legs; corners of more than 120 degrees) its radius is smaller. Its departure from the
/// corner, the largest there is, is r (1 / cos(phi / 2) - 1) for radius r and corner phi: 0.41 r at 90 degrees; from
/// the legs it departs by up to half of the given radius.
///
/// Dwell points that the arc cuts off are replaced by points in the middles of equal parts of it: as closely spaced as
/// the closer neighbour of the corner was, at most twice as many as were cut off unless more are needed to turn by at
/// most kArcTurnDeg at each. So the polyline through the dwell points, and with it the tool on its way from dwell point
/// to node to dwell point, turns by at most 30 degrees anywhere (24 on an arc, and 6 more where the move from it leads
/// onto a wider one), except at turn-backs and at points that repeat the one before. A move is at most 1.5 times as
/// long as the longest of those it replaces. The first and last points of pieces stay, and lifts stay where they are. A
/// note says how many corners were rounded, and how many with less than asked for.
///
/// radius = 0 returns the path itself. Throws InputError, which names the kind of the path, if the radius is negative
/// or not finite or the result has more than kMaxPathPoints points; as validate() does if the path is not valid. Cost
/// and memory O(points).
ToolPath round_corners(const ToolPath& path, double radius, const Progress& progress = {});

}  // namespace dwell
