#pragma once

#include "core/formats/remark_phrases.h"

namespace dwell {

// Whether a word of a remark speaks of the unit of a map's numbers.

/// "amplitude in um", "residual, microns"; not the unit of a number or of another quantity.
bool speaks_of_a_unit(const Remark& words, std::size_t at);

/// "OPD in waves at 633 nm", but not "0.1 waves" or "fringe projection".
bool speaks_of_waves(const Remark& words, std::size_t at);

}  // namespace dwell
