#pragma once

#include <string>
#include <string_view>

#include "core/base/grid_limit.h"
#include "core/formats/map_source.h"
#include "core/map/height_map.h"

namespace dwell {

/// Whether the bytes begin as an HDF5 file does.
bool is_hdf5(std::string_view bytes);

/// Reads the one map of an HDF5 file: the surface of a Zygo .datx (core/formats/zygo_datx.h), or the only
/// two-dimensional data set of numbers; of several, the message lists their paths. The first index is the row (y).
/// Attributes of the data set, all optional: `pitch_mm` (one number, or x and y), `origin_mm` (x and y), `unit`,
/// `history` (lines of text), and what others call these (core/formats/hdf5_fields.h); the coordinates of its axes
/// (core/formats/hdf5_axes.h); packed values as CF has them (core/formats/hdf5_packing.h), which the history then says.
/// Reading is done in a process of its own (core/formats/isolated_reader.h). Throws InputError beginning with `where`.
MapSource parse_hdf5(std::string_view bytes, const std::string& where, const PixelLimit& limit = {});

/// Reads the data set at a path in the file.
MapSource parse_hdf5_at(std::string_view bytes, const std::string& path, const std::string& where,
                        const PixelLimit& limit = {});

/// An HDF5 file that reads back equal: the data set `map` with all four attributes, unit nm.
std::string hdf5_map_bytes(const HeightMap& map);

}  // namespace dwell
