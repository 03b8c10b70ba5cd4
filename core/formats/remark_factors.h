#pragma once

#include "core/formats/remark_phrases.h"

namespace dwell {

// Whether a word of a remark speaks of a factor between the numbers of a map and heights.

/// "nm/count", "nm per fringe", "counts per nm".
bool is_per_count(const Remark& words, std::size_t at);

/// "gain of 2.5", "scaled by 1000", "x 1e-3", "[10 nm]", "in 1e-9 m" beside a word for the values; "height = 0.5 *
/// value", "1 count = 0.1 nm", "counts to nm", "x1000", "normalised".
bool is_a_factor(const Remark& words, std::size_t at);

}  // namespace dwell
