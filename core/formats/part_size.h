#pragma once

#include <string>

#include "core/base/grid.h"

namespace dwell {

/// Throws InputError unless the pitches and the size of the part are those of an optical part: a pitch of at least
/// 1e-7 mm (a tenth of a nanometre) and a part of at most 20 m. What is beyond was read in a wrong unit: lengths in m
/// taken for mm or the reverse. `field` names what said the pitch, with its value; `where` begins the message.
void check_part_size(const Grid& grid, const std::string& field, const std::string& where);

}  // namespace dwell
