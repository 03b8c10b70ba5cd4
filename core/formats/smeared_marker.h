#pragma once

#include <cstddef>
#include <vector>

namespace dwell {

/// Whether a value is a mark for no data over which somebody has interpolated: a whole number `in_file` of 99 or more,
/// in four pixels or more, while those of the others that are over two pixels away from it span less than a tenth of
/// their distance to it. What lies between stands at the rim of the mark alone. `values` are a grid of `cols` columns,
/// NaN = no data. Cost O(pixels).
bool is_smeared_marker(const std::vector<double>& values, std::size_t cols, double value, double in_file);

}  // namespace dwell
