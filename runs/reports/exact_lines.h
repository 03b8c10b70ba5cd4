#pragma once

#include <string>

#include "core/removal/exact_residual.h"

namespace dwell {

/// Two lines for people on how an exact residual was found, and what it leaves out: the standard error and the number
/// of pixels, and the ripple within pixels. Each begins with a word and ends with a new line.
std::string exact_lines(const ExactResidual& exact);

}  // namespace dwell
