#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dwell {

/// The name of something that a comment states, taken to pieces: "X pixel size [um]" is the stem "pixelsize" along x
/// in um. Case, blanks, '_', '-' and words that say nothing ("in", "the", "is") do not count.
struct HeaderKey {
  std::string shown;               // as in the file, for messages
  std::vector<std::string> words;  // folded (core/formats/map_terms.h), without axis and unit
  std::string stem;                // the words, joined
  char axis = 0;                   // 'x', 'y', 'z', or 0 where none is named
  bool every_axis = false;         // z beside x or y ("x, y, z units"); axis is then 'z'
  std::optional<double> length;    // a unit of length that the name holds [nm]
  std::string unit;                // a unit of length or rate that the name holds, as in the file; empty: none
  std::string remark;              // what else stands in brackets, in lower case
  bool per_pixel = false;          // "mm/pixel"

  bool has(std::string_view word) const;
};

/// Takes a name apart. Of x and y the first counts.
HeaderKey parse_header_key(std::string_view text);

/// Numbers with a unit of length or without: "0.5", "0.1 x 0.2 mm", "[250, 250] um", "12.000 mm", "0.5 mm/pixel".
struct HeaderLengths {
  std::vector<double> numbers;   // as written
  std::optional<double> length;  // the unit after them, which counts for all [nm]; nothing: no unit, or pixels
  bool pixels = false;           // the unit is pixels
  double rounding = 0.0;         // half a unit of the last digit of the coarsest number, as a part of that number

  /// The numbers in mm; `otherwise` is the unit [nm] of numbers that have none of their own.
  std::vector<double> mm(double otherwise) const;
};

/// Nothing if the text is anything else, or has more than `most` numbers, or units that differ.
std::optional<HeaderLengths> parse_header_lengths(std::string_view text, std::size_t most = 2);

/// Whether a comma may be a decimal comma or part two numbers: "0,5 mm", but not "0.5,0.5" or "1, 2".
bool may_have_decimal_comma(std::string_view text);

/// The words between blanks.
std::vector<std::string_view> words_of(std::string_view text);

/// Whether all of the words speak of the values of a map: "height", "surface error". False of none.
bool are_value_words(const std::vector<std::string>& words);

}  // namespace dwell
