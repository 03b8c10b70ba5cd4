#pragma once

#include <string>

#include "core/map/height_map.h"

namespace dwell {

/// What is done about a removal function that still removes at the rim of its file, where it should remove nothing.
enum class TifPedestal {
  Subtract,  // the mean of the rim is taken off all samples: for an offset of the measurement
  Taper,     // a cosine takes the outer part of the file to zero: for a true tail that the file cuts off
  Accept     // the rates stay as they are
};

/// "subtract", "taper" or "accept". Throws InputError.
TifPedestal parse_tif_pedestal(const std::string& text);
std::string to_string(TifPedestal how);

/// Does it in place, and appends to the history what was done, with numbers. Samples without data stay so. The taper
/// multiplies a sample k steps from the rim (core/tif/rate_rim.h) by (1 - cos(pi k / n)) / 2 for k < n, n being an
/// eighth of the shorter side of the grid, at least two. Cost O(samples).
void mend_pedestal(HeightMap& rates, TifPedestal how);

}  // namespace dwell
