#include "core/formats/text_grid.h"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"

namespace dwell {
namespace {

[[noreturn]] void refuse_short(const TextGrid& grid, const std::string& found, const std::string& where) {
  throw InputError(fmt::format("{}: truncated; {}, {} of {} values are required", where, found,
                               counted(grid.rows, "row"), grid.cols));
}

}  // namespace

std::optional<Index> parse_count(std::string_view text) {
  text = trim(text);
  Index count = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || stop != text.data() + text.size() || count < 1) return std::nullopt;
  return count;
}

std::vector<double> read_text_grid(TextWords& words, const TextGrid& grid, std::size_t text_size,
                                   const std::function<std::optional<double>(std::string_view)>& value,
                                   const std::string& where) {
  const auto rows = static_cast<std::size_t>(grid.rows), cols = static_cast<std::size_t>(grid.cols);
  // A value takes a character and a blank at least. Divided, not multiplied: an absurd size must not overflow.
  if (rows > (text_size / 2 + 1) / cols) refuse_short(grid, fmt::format("the file has {} bytes", text_size), where);
  check_pixels(static_cast<double>(rows), static_cast<double>(cols), grid.limit, where);
  std::vector<double> values(rows * cols);
  for (std::size_t row = 0; row < rows; ++row) {
    double* const out = values.data() + (grid.top_first ? rows - 1 - row : row) * cols;
    for (std::size_t col = 0; col < cols; ++col) {
      if (!words.next()) refuse_short(grid, fmt::format("it ends after {}", counted(row * cols + col, "value")), where);
      const std::optional<double> number = value(words.word());
      if (!number) {
        throw InputError(
            fmt::format("{}, line {}: {} where value {} of row {} of the grid is required; a finite number "
                        "is accepted, and {} for no data",
                        where, words.line(), in_quotes(words.word()), col + 1, row + 1, grid.no_data));
      }
      out[col] = *number;
    }
  }
  return values;
}

}  // namespace dwell
