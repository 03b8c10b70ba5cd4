#pragma once

#include <string>
#include <vector>

#include "core/base/point.h"

namespace dwell {

/// Where the tool goes: dwell points in the order of the run. `lifted[j]` says that the move which arrives at point
/// j is made with the tool lifted (it removes nothing and the stretch of path is cut there); lifted[0] is always
/// taken as true, since the tool must arrive from somewhere.
struct ToolPath {
  std::string kind;           // "raster", "nearest", "file", ...
  std::vector<Point> points;  // n dwell points [mm]
  std::vector<char> lifted;   // n flags
  /// What the planner has to say to the user, a sentence each: points it left out and why, options it chose.
  std::vector<std::string> notes{};

  std::size_t size() const { return points.size(); }
};

/// The stretch of path over which dwell point j spends its dwell time: the polyline start -> via -> finish, at one
/// speed. via = the dwell point itself. A stretch of zero length is a halt.
struct Stroke {
  Point start;
  Point via;
  Point finish;

  double length() const { return distance(start, via) + distance(via, finish); }
};

/// Dwell belongs to a stretch of path, not to a dot (docs/math.md, "Nodes"). The path is cut at its ends and at lifts;
/// in each piece, dwell point j stands for the stretch from node q_(j-1) through p_j to node q_j. n strokes, in order.
///
/// Nodes lie halfway between neighbouring dwell points; at the ends of a piece the stretch is extended straight on by
/// its other half, so that it is symmetric about its point; a point alone in its piece is a halt. In one case the nodes
/// are known exactly: where all points of a piece are the midpoints of a chain of equal steps (to kEqualSteps of a
/// step), as planners that lay segments write them, the chain's own nodes are used, so that the tool turns where the
/// chain turns and all strokes but perhaps the last are equally long. A chain does not turn by more than 120 degrees.
/// On a straight line of equal steps the two are the same.
inline constexpr double kEqualSteps = 1e-3;
std::vector<Stroke> moving_strokes(const ToolPath& path);

/// The strokes of a tool that halts at every dwell point: start = via = finish = p_j.
std::vector<Stroke> halting_strokes(const ToolPath& path);

/// Checks sizes and finiteness; throws InputError naming the first bad point (1-based).
void validate(const ToolPath& path);

}  // namespace dwell
