#pragma once

#include <string>

#include "core/base/grid_limit.h"

namespace dwell {

/// A file that unpacks to more than so many times its size, and to more than kMostUnpacked bytes, is taken for one that
/// was made to fill the memory.
inline constexpr double kMostUnpacking = 100.0;
inline constexpr double kMostUnpacked = 268435456.0;

/// Throws InputError unless an array of rows x cols numbers from a file of `file_bytes` bytes is within the limit of
/// pixels and no such file. A limit that the user gave allows any unpacking up to it. Ask before taking the memory.
/// `what` begins the message: "map a.h5: HDF5 data set '/m'".
void check_unpacked(double rows, double cols, double file_bytes, const PixelLimit& limit, const std::string& what);

}  // namespace dwell
