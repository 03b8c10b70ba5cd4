#pragma once

#include <array>

#include "core/base/grid.h"
#include "core/base/progress.h"
#include "core/motion/tool_path.h"

namespace dwell {

inline constexpr std::size_t kDirectionBins = 36;  // of 5 degrees, centred on 0, 5, ..., 175 degrees

/// Lengths are in mm, angles in degrees. Turns and directions are those of the moves between dwell points made with the
/// tool down; moves of no length have no direction and are skipped.
struct PathMetrics {
  Index points = 0;
  double length = 0.0;         // of the strokes of a moving tool: where it removes (N g for N points of spacing g)
  double point_length = 0.0;   // from dwell point to dwell point, all moves, lifted or not ((N - 1) g); Xie et al. 2022
  double lifted_length = 0.0;  // the part of point_length that is lifted
  double longest_jump = 0.0;   // largest distance between consecutive dwell points, lifted or not
  Index lifts = 0;             // lifted moves between dwell points; the arrival at the first is not counted

  /// Turns by more than 90 degrees between successive moves of one piece of path (a lift between them makes none). The
  /// two square corners by which a serpentine changes lines do not count; a one-point-wide spike or a zigzag does.
  Index reversals = 0;
  double sharpest_corner = 0.0;  // largest turn between successive moves of a piece: 0 straight on, 180 back again

  /// Share of the length of all moves, tool down, by direction; a move and its opposite count as the same direction.
  /// Bin k: from 5 k - 2.5 (included) to 5 k + 2.5 degrees, counter-clockwise from +x. Sums to 1; all 0 without moves.
  std::array<double, kDirectionBins> directions{};

  /// |sum L exp(2 i phi)| / sum L over the same moves of length L and direction phi: 1 = all parallel, 0 = none
  /// preferred, or two preferred at right angles in equal shares.
  double anisotropy = 0.0;

  /// |sum L exp(4 i phi)| / sum L: 1 = all along two directions at right angles (any path on a square lattice of which
  /// no move is diagonal), near 0 for a curve that goes all ways.
  double lattice_anisotropy = 0.0;
};

/// Throws InputError if the path is not valid. Cost O(points). The metrics that need a search are in path_spacing.h,
/// path_coverage.h and spanning_tree.h.
PathMetrics path_metrics(const ToolPath& path, const Progress& progress = {});

}  // namespace dwell
