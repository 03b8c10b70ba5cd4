#pragma once

#include <string>

#include "core/map/height_map.h"

namespace dwell {

/// Factor from a unit of height ("nm", "um", "mm", "m") to nm. Throws InputError naming the accepted ones.
double height_unit_nm(const std::string& unit);

/// Factor from a unit of removal rate ("nm/s", "um/s", "um/min", "m/s") to nm/s. Throws InputError likewise.
double rate_unit_nm_per_s(const std::string& unit);

/// The one of the two that the quantity asks for.
double unit_factor(const std::string& unit, MapQuantity quantity);

/// The unit inside: "nm" or "nm/s".
std::string unit_of(MapQuantity quantity);

}  // namespace dwell
