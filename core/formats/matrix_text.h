#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/formats/map_source.h"
#include "core/map/height_map.h"

namespace dwell {

/// Reads a matrix of numbers (docs/formats.md): one row a line, separated by ';', else ',', else tab, else blanks --
/// whichever the first row has. `where` begins error messages, as in "map a.csv". With `named_columns` given, a first
/// row of names is taken for a row without data and said there; else it is refused as any other word. Throws InputError
/// naming line and column of a ragged row, of what is not a number, and of an infinity. Cost O(bytes).
MapSource parse_matrix_text(std::string_view text, const std::string& where, bool* named_columns = nullptr);

/// The map as text with a header, in nm (rates in nm/s), every number with the digits that read back equal.
std::string matrix_text(const HeightMap& map, char separator);

}  // namespace dwell
