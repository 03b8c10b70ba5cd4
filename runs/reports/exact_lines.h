#pragma once

#include <optional>
#include <string>

#include "core/form/map_statistics.h"
#include "core/removal/exact_residual.h"

namespace dwell {

/// Two lines for people on how an exact residual was found, and what it leaves out: the standard error and the number
/// of pixels, and the ripple within pixels. Each begins with a word and ends with a new line.
std::string exact_lines(const ExactResidual& exact);

/// The limit that a program reaches if it leaves more than there was before, both about zero, since a piston counts
/// where it is not removed: a sentence with both figures. Nothing if it does not.
std::optional<std::string> more_than_before(const ExactResidual& exact, const MapStatistics& before);

}  // namespace dwell
