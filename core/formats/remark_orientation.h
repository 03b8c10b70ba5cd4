#pragma once

#include <string_view>

#include "core/formats/remark_phrases.h"

namespace dwell {

// Whether a remark says which way a map lies, in other words than this program's: the first row is that of the smallest
// y, rows are the first index, x points to the right and y up, and the part is seen from the front.

/// "row 0 = top", "rows = x, columns = y", "first index is x", "Fortran order": of the rows of an array.
bool speaks_of_rows(const Remark& words);

/// "image flipped", "y axis points down", "left-handed", "viewed from the back": of x and y, and so of points too.
bool speaks_of_axes(const Remark& words);

/// Either, of a remark as text.
bool names_orientation(std::string_view remark);

/// "sign: -1", "heights negated", "positive = hole": heights that grow into the part.
bool speaks_of_a_sign(const Remark& words);

}  // namespace dwell
