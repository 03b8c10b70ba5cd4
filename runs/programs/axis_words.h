#pragma once

#include <string>

#include "core/motion/axis_letters.h"

namespace dwell {

/// Why a letter of a program is no axis of a machine with these letters, though it may be one of another machine: names
/// both. Empty for letters of this machine, and for those that no axis of the plane has.
std::string why_no_axis(char letter, AxisLetters letters);

}  // namespace dwell
