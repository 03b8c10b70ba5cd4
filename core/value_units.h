#pragma once

#include <string>

namespace dwell {

/// Factor from a unit of height ("nm", "um", "mm", "m") to nm. Throws InputError naming the accepted ones.
double height_unit_nm(const std::string& unit);

/// Factor from a unit of removal rate ("nm/s", "um/s", "um/min", "m/s") to nm/s. Throws InputError likewise.
double rate_unit_nm_per_s(const std::string& unit);

/// Either of the two, for files that may hold heights or rates.
double value_unit_factor(const std::string& unit);

}  // namespace dwell
