#pragma once

#include "core/formats/remark_phrases.h"

namespace dwell {

// Whether a word of a remark speaks of how the numbers of a map stand for heights.

/// "amplitude in um", "residual, microns"; not the unit of a number or of another quantity.
bool speaks_of_a_unit(const Remark& words, std::size_t at);

/// "OPD in waves at 633 nm", but not "0.1 waves" or "fringe projection".
bool speaks_of_waves(const Remark& words, std::size_t at);

/// "nm/count", "nm per fringe", "counts per nm".
bool is_per_count(const Remark& words, std::size_t at);

/// "gain of 2.5", "scaled by 1000", "x 1e-3", "[10 nm]", "in 1e-9 m" beside a word for the values.
bool is_a_factor(const Remark& words, std::size_t at);

}  // namespace dwell
