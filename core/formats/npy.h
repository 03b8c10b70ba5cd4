#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/grid_limit.h"
#include "core/formats/map_source.h"
#include "core/map/height_map.h"

namespace dwell {

bool is_npy(std::string_view bytes);

/// Reads a two-dimensional NPY array, format 1, 2 or 3: C or Fortran order, either byte order, f4 f8 i1 i2 i4 i8 u1 u2
/// u4 u8 (integers beyond 2^53 are rounded). `where` begins error messages. Throws InputError naming what is not so,
/// and sizes of a file that is too short or too long. Source: numpy.lib.format.
MapSource parse_npy(std::string_view bytes, const std::string& where, const PixelLimit& limit = {});

/// NPY format 1 of the map's values ('<f8', C order, rows x cols); grid and unit are not in it.
std::string npy_bytes(const HeightMap& map);

/// NPY format 1 of a vector ('<f8', one dimension).
std::string npy_bytes(std::span<const double> values);

}  // namespace dwell
