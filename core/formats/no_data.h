#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dwell {

/// What the user says of values that stand for no data.
struct NoDataMarkers {
  std::vector<double> values;  // as the file holds them; empty = none is, every number is a height
};

/// "-9999", "-9999,32767" or "none". Throws InputError naming what is accepted.
NoDataMarkers parse_no_data(const std::string& text);

/// The text that parses to it again.
std::string to_string(const NoDataMarkers& markers);

/// Numbers of a file and what it says of them.
struct RawValues {
  std::vector<double>* values;  // as read; NaN = no data
  double factor = 1.0;          // the reader has multiplied the file's numbers by it
  std::vector<double> no_data;  // what the file itself says stands for no data
  std::size_t cols = 0;         // of the grid, row-major; 0: points, or a grid of nobody knows how many columns
};

/// The least of the numbers that stand for no data without anybody saying so, as the file holds them.
inline constexpr double kLeastMarker = 1e20;

/// Whether a number of a file is one that programs write for no data and that no instrument means as a height: the
/// largest float (3.4e38), half of it, the largest double, half of it, 9.97e36 of netCDF, 2^100, 1e300,
/// 1e308, 9.999e20, 9.99e33, and the powers of ten from 1e20 to 1e38; of either sign. Other numbers as large (1e150)
/// are slips.
bool is_huge_marker(double value);

/// Whether a number of a file is the marker, which may be written with more digits than single precision holds.
bool is_marker(double value, double marker);

/// Sets to NaN what is no height: numbers that is_huge_marker knows, and those that the file or the user names. Returns
/// a line each, for the map's history. Without a word of the user, one extreme value is refused that stands in four
/// pixels or more while nothing else is near it (-9999, 32767, 65535 around a part): farther from all others than ten
/// times what 98 % of these span; or, on a grid, smeared into the part at its rim alone
/// (core/formats/smeared_marker.h). Never so 0, which flat parts, masks and removal functions have. `where` begins the
/// message, `name` is "map" or "tif" (the option to name). Throws InputError. Cost O(values).
std::vector<std::string> remove_no_data(const RawValues& raw, const std::optional<NoDataMarkers>& asked,
                                        const std::string& where, const std::string& name);

}  // namespace dwell
