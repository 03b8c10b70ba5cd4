#pragma once

#include <optional>
#include <string_view>

namespace dwell {

/// The urad in one of the unit of slope that the text names: rad, mrad, urad, nrad, deg, arcmin, arcsec, each by its
/// sign or its word ("µrad" with either mu and in Latin-1, "microradians", "micro-rad"), or a length by a length
/// ("nm/mm", "um/m"), in any case. Nothing if it names none.
std::optional<double> known_slope_unit(std::string_view text);

}  // namespace dwell
