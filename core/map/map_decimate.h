#pragma once

#include "core/base/grid_limit.h"
#include "core/base/progress.h"
#include "core/map/height_map.h"

namespace dwell {

/// The map with every block of row_factor x col_factor pixels averaged into one, which lies at the middle of its block;
/// the blocks start at pixel (0, 0). A new pixel is the mean of the finite pixels of its block, and has data if these
/// are at least half of the block, counted whole where it sticks out over the map's end; a row or column of blocks that
/// cannot reach half is left out. On a slope, the mean of a block that is not full is off, because it belongs to the
/// middle of the pixels with data and not to that of the block. Throws InputError for a factor < 1 or if no block has
/// data; Interrupted. Cost O(pixels).
HeightMap decimate_map(const HeightMap& map, Index row_factor, Index col_factor, const Progress& progress = {});

/// The map at other pitches [mm, in x and y]: by block average over the whole number of pixels that a new one spans in
/// each direction, if that is more than one (anti-aliasing), then by cubic B-spline (core/map/map_sampler.h). The first
/// pixel of the new map lies on the first one of the map, or of the averaged map, and the last one not beyond the last
/// of it. Throws InputError unless ranges::kPitch holds the pitches and the result is within the limit; Interrupted.
HeightMap resample_map(const HeightMap& map, Point pitch, int threads = 1, const PixelLimit& limit = {},
                       const Progress& progress = {});

}  // namespace dwell
