#pragma once

#include "core/formats/remark_phrases.h"

namespace dwell {

// Whether a word of a remark speaks of where the pixels or the points of a map lie.

/// "pixel indices", "coordinates in pixels", "0.1 mm per pixel", "x and y in inches".
bool speaks_of_places(const Remark& words, std::size_t at);

/// "all lengths in m": the coordinates too.
bool speaks_of_all(const Remark& words, std::size_t at);

/// "centre at 50, 50", "origin: centre", "extent 0 100 0 80", "x from -25 to 25 mm".
bool speaks_of_an_origin(const Remark& words, std::size_t at);

/// "shifted by 3 mm", "x offset 10": the places of points may be those before it.
bool speaks_of_a_shift(const Remark& words, std::size_t at);

}  // namespace dwell
