#pragma once

#include <string>

#include "core/base/grid.h"

namespace dwell {

/// The line of a table on the map's size and pitch, both pitches where they differ, and the number of pixels in the
/// aperture; "map" begins it, a new line ends it.
std::string map_line(const Grid& grid, Index pixels);

}  // namespace dwell
