#pragma once

#include <cstddef>
#include <vector>

namespace dwell {

/// What lies between a mark for no data and the part.
enum class MarkerRim {
  None,          // the value is no mark
  Sharp,         // nothing
  Interpolated,  // heights on the way from the one to the other: somebody has interpolated over the mark
};

/// Whether a value is a mark for no data that stands out from the part: a whole number `in_file` of 99 or more, in four
/// pixels or more, while those of the others that are over two pixels away from it span less than a tenth of their
/// distance to it. What lies between stands at the rim of the mark alone. `values` are a grid of `cols` columns, NaN =
/// no data. Cost O(pixels).
MarkerRim rim_of_marker(const std::vector<double>& values, std::size_t cols, double value, double in_file);

}  // namespace dwell
