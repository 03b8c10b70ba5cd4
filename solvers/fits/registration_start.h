#pragma once

#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// Where to look for the place of one map on another.
struct RegistrationRange {
  double shift = 0.0;    // each way in x and y [mm], >= 0
  double degrees = 0.0;  // each way, >= 0
};

struct RegistrationStart {
  Point shift;           // of the moving map's middle [mm]
  double degrees = 0.0;  // counter-clockwise about it
};

/// The shift and rotation that bring `moving` best onto `fixed`, by exhaustive search. Both maps, less their robust
/// planes, are averaged in blocks until the fixed one has at most kStartPixels pixels. Tried is every shift by whole
/// such pixels, with rotations in steps that move the corner of the moving map by one. The best one has the smallest
/// standard deviation of the difference over the common pixels, which must be at least kStartOverlap of the smaller
/// map. Heights are those of the nearest pixels. Good to about one averaged pixel. Throws InputError if no place has
/// that overlap, Interrupted. Cost O(kStartPixels) a place.
RegistrationStart coarse_registration(const HeightMap& moving, const HeightMap& fixed, const RegistrationRange& range,
                                      int threads = 1, const Progress& progress = {});

inline constexpr Index kStartPixels = 3000;
inline constexpr double kStartOverlap = 0.4;

}  // namespace dwell
