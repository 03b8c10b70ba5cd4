#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// A column of a line profile as the file names it: "x-position [mm]", "Slope (urad)", "height_nm".
struct ProfileColumn {
  std::string shown;               // as in the file, for messages
  std::vector<std::string> words;  // in lower case, without units: "x", "position"
  std::string unit;                // known, or whatever stands in brackets; empty: none

  bool is_place() const;   // x, position, abscissa and their like
  bool is_slope() const;   // slope, Steigung, pente, gradient
  bool is_height() const;  // height, z, sag, Höhe, hauteur
};

/// The words of a name, for comparison: letters and digits, in lower case.
std::vector<std::string> profile_words(std::string_view name);

/// Reads a line (without the sign of a comment) that names as many columns as the table has: separated by semicolons,
/// tabs, commas or blanks, one of them a place and one a slope or height. Empty of any other line.
std::vector<ProfileColumn> parse_profile_columns(std::string_view line, std::size_t count);

}  // namespace dwell
