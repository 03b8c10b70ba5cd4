#pragma once

#include <optional>
#include <vector>

#include "core/base/grid.h"

namespace dwell {

/// A one-dimensional lattice: origin + pitch k, k = 0 .. count - 1.
struct Lattice {
  double origin = 0.0;
  double pitch = 0.0;  // 0: all coordinates are the same, none can be inferred
  Index count = 0;

  /// Number of the nearest lattice point, bounded to +-1e15 where v is absurdly far.
  Index nearest(double v) const;
  /// Distance from the nearest lattice point, as a fraction of the pitch; 0 if that is 0.
  double deviation(double v) const;
};

/// How far a coordinate may be from its lattice point, as a fraction of the pitch: more than the rounding of
/// coordinates printed with few digits (0.094 for 0.0938 is 0.002), far less than a point out of place.
inline constexpr double kLatticeTolerance = 0.05;

struct LatticeFit {
  Lattice lattice;
  bool fits = false;  // every coordinate lies within kLatticeTolerance of it
};

/// The coarsest lattice that holds the coordinates (any order, repeated, gaps allowed), by least squares. The pitches
/// tried are, in this order: the median step between neighbours; the smallest step, if a quarter of the steps are of
/// its size (a lattice with most lines missing); `pitch`. If none fits, the first one tried is returned with fits =
/// false: a stray point deviates from it most. Coordinates must be finite, at least one. Cost O(n log n).
LatticeFit fit_lattice(std::vector<double> coordinates, std::optional<double> pitch = std::nullopt);

}  // namespace dwell
