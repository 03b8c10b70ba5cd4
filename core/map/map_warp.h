#pragma once

#include "core/base/grid_limit.h"
#include "core/base/progress.h"
#include "core/map/height_map.h"
#include "core/numerics/plane_transform.h"

namespace dwell {

/// The map on another grid, moved by `forward`: pixel p of the target takes the height at forward^-1(p), between pixels
/// by cubic B-spline (core/map/map_sampler.h, which says where there is no data). No averaging: where the target is
/// coarser than the map, decimate first. Throws InputError if `forward` cannot be inverted or no pixel of the target
/// has data, Interrupted. Cost O(pixels of both).
HeightMap warp_map(const HeightMap& map, const PlaneTransform& forward, const Grid& target, int threads = 1,
                   const Progress& progress = {});

/// The smallest grid of the same pitches that covers all pixel centres of `grid` moved by `forward`. Its middle lies
/// where theirs is moved. Throws InputError if it is larger than the limit.
Grid covering_grid(const Grid& grid, const PlaneTransform& forward, const PixelLimit& limit = {});

/// The map turned counter-clockwise by any angle about a point [mm], on the covering grid. For
/// multiples of 90 degrees core/map/map_turn.h is exact.
HeightMap rotate_map(const HeightMap& map, double degrees, Point about, int threads = 1, const PixelLimit& limit = {},
                     const Progress& progress = {});

}  // namespace dwell
