#pragma once

#include "core/base/grid_limit.h"
#include "core/map/height_map.h"

namespace dwell {

/// The map with every block of row_factor x col_factor pixels averaged into one, which lies at the middle of its block;
/// the blocks start at pixel (0, 0). A new pixel is the mean of the finite pixels of its block, and has data if these
/// are at least half of the block, counted whole where it sticks out over the map's end; a row or column of blocks that
/// can not reach half is left out. In a block that is not full, a slope shows: its mean belongs to the middle of what
/// it has. Throws InputError for a factor < 1 or if no block has data. Cost O(pixels).
HeightMap decimated(const HeightMap& map, Index row_factor, Index col_factor);

/// The map at other pitches [mm, in x and y]: by block average over the whole number of pixels that a new one spans in
/// each direction, if that is more than one (anti-aliasing), then by cubic B-spline (core/map/map_sampler.h). The first
/// pixel of the new map lies on the first one of the map, or of the averaged map, and the last one not beyond the last
/// of it. Throws InputError unless the pitches are finite and > 0 and the result is within the limit.
HeightMap resampled(const HeightMap& map, Point pitch, int threads = 1, const PixelLimit& limit = {});

}  // namespace dwell
