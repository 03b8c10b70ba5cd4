#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

struct FillOptions {
  bool all = false;      // also what reaches the map's edge: the whole rectangle gets heights
  double largest = 0.0;  // holes of a larger area [mm^2] are left; 0 = no limit
};

struct FillSummary {
  Index holes = 0;   // filled
  Index pixels = 0;  // in them
  Index left = 0;    // holes larger than allowed
};

/// Fills holes by the harmonic surface through the heights around them (core/numerics/laplace.h): smooth, without bumps
/// of its own, never above or below what surrounds the hole. A hole is a set of pixels without data, joined by their
/// sides, that does not reach the map's edge. Throws InputError if no pixel is finite.
FillSummary fill_holes(HeightMap& map, const FillOptions& options, const Progress& progress = {});

}  // namespace dwell
