#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/grid_limit.h"
#include "core/base/text_words.h"

namespace dwell {

/// How a file lays out a grid of numbers separated by blanks and line ends, column after column of each row.
struct TextGrid {
  Index rows = 0;
  Index cols = 0;
  bool top_first = false;  // the first row of the file has the largest y, not the smallest
  std::string no_data;     // what stands for no data, for messages: "BAD"
  PixelLimit limit;
};

/// Reads rows x cols words into a row-major array with row 0 at the smallest y. `value` gives a word's number (NaN for
/// no data) or nothing if it is none. `text_size` is the size of the whole file [bytes], which bounds the array before
/// it is made. `where` begins error messages. Throws InputError for a grid larger than the file can hold or than its
/// limit, a file that ends too early, and a word that is no number, with its line. Cost O(bytes).
std::vector<double> read_text_grid(TextWords& words, const TextGrid& grid, std::size_t text_size,
                                   const std::function<std::optional<double>(std::string_view)>& value,
                                   const std::string& where);

/// A number of rows or columns: a whole number >= 1. Nothing if the text is none.
std::optional<Index> parse_count(std::string_view text);

}  // namespace dwell
