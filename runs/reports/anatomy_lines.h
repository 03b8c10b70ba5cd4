#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "core/anatomy/residual_anatomy.h"
#include "core/form/map_statistics.h"

namespace dwell {

/// Lines for people on what a residual consists of: its parts, the blemishes with the most squares, and the figures
/// without them beside those `with` all pixels. Each begins with a word or blanks and ends with a new line.
std::string anatomy_lines(const ResidualAnatomy& anatomy, const MapStatistics& with);

/// The same as JSON (docs/json.md, "anatomy"). At most kListedBlemishes are listed one by one, those with the most
/// squares; `advice` is residual_advice.
nlohmann::ordered_json anatomy_block(const ResidualAnatomy& anatomy, const std::string& advice);

inline constexpr std::size_t kListedBlemishes = 200;

}  // namespace dwell
