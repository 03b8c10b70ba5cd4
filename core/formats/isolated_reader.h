#pragma once

#include <functional>
#include <string>

#include "core/base/grid_limit.h"
#include "core/formats/map_source.h"

namespace dwell {

/// Reads a map in a process of its own (core/base/child_process.h), for libraries that crash, loop or eat memory on
/// corrupt files: whatever happens there, here it is a map or an InputError. InputErrors of `read` pass through; if
/// there was no answer, one that begins with `where` and says that `format`, a file of `bytes` bytes, is corrupt.
/// Allows 2 s of processor time and another for every 4 MB of the file and every 100 MB that it may unpack to, and 4
/// GiB of memory and another 16 bytes for every one; where the user gave a limit of pixels, 12 bytes for each of them
/// more.
MapSource read_isolated(const std::function<MapSource()>& read, std::size_t bytes, const std::string& format,
                        const std::string& where, const PixelLimit& limit = {});

}  // namespace dwell
