#pragma once

#include <string>
#include <string_view>

#include "core/base/point.h"
#include "core/motion/program_frame.h"

namespace dwell {

/// A frame with numbers as files can say them: zero to 1e-6 mm, degrees to 1e-9.
ProgramFrame rounded_frame(Point zero, double degrees, bool swapped);

/// What files say of their frame: "zero=12.500000/-3.000000 rotate=90 swap=no". At most 67 characters for places within
/// 1e6 mm.
std::string frame_text(const ProgramFrame& frame);

/// Reads frame_text. Throws InputError naming the text and what is accepted: another order, a number out of range, more
/// words.
ProgramFrame parse_frame(std::string_view text);

}  // namespace dwell
