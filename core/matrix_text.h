#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/height_map.h"
#include "core/map_header.h"

namespace dwell {

/// A matrix of heights as a text file has it: no grid yet, only what its comment lines say of one.
struct MatrixText {
  Index rows = 0;
  Index cols = 0;
  std::vector<double> values;  // row-major, row 0 = first line; NaN = no data; in the file's unit
  MapHeader header;
};

/// Reads a matrix of numbers (docs/formats.md): one row a line, separated by ';', else ',', else tab, else blanks --
/// whichever the first row has. `where` begins error messages, as in "map a.csv". Throws InputError naming line and
/// column of a ragged row, of what is not a number, and of an infinity. Cost O(bytes).
MatrixText parse_matrix_text(std::string_view text, const std::string& where);

/// The map as text with a header, in nm, every number with the digits that read back equal.
std::string matrix_text(const HeightMap& map, char separator);

}  // namespace dwell
