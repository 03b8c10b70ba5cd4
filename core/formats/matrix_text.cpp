#include "core/formats/matrix_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/formats/text_comment.h"
#include "core/formats/text_header.h"

namespace dwell {
namespace {

char separator_of(std::string_view row) {
  for (const char separator : {';', ',', '\t'}) {
    if (row.find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

/// Cuts the next field off the row; false if there is none. Runs of blanks are one separator; of the others each
/// ends a field, so that an empty field is a pixel without data.
bool next_field(std::string_view& row, bool& more, char separator, std::string_view& field) {
  if (!more) return false;
  if (separator == ' ') row.remove_prefix(std::min(row.find_first_not_of(" \t"), row.size()));
  const std::size_t end = separator == ' ' ? row.find_first_of(" \t") : row.find(separator);
  field = row.substr(0, end);
  more = end != std::string_view::npos;
  row.remove_prefix(more ? end + 1 : row.size());
  return true;
}

/// Why a field is no height; of "5<tab>2" in "1,5<tab>2,5", that the commas are decimal commas.
std::string why_no_field(std::string_view field, char separator) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t gap = separator == ',' ? trim(field).find_first_of(" \t") : std::string_view::npos;
  const bool numbers = gap != std::string_view::npos && finite_number(trim(field).substr(0, gap)) &&
                       finite_number(trim(field).substr(gap)) &&
                       kDigits.find(trim(field).back()) != std::string_view::npos;
  if (!numbers) return why_no_height(field);
  return fmt::format(
      "{} is not a number; if the commas are decimal commas: these are not accepted, write points (one "
      "kind of separator a file)",
      in_quotes(field));
}

/// Where a row stands, and whether words in it are names of columns.
struct RowPlace {
  const std::string& where;
  long line;
  bool may_name;
  bool* names;  // set if it does
};

/// Appends the row's values; returns their number.
Index read_row(std::string_view row, char separator, const RowPlace& place, std::vector<double>& values) {
  Index count = 0;
  bool more = true;
  for (std::string_view field; next_field(row, more, separator, field);) {
    ++count;
    std::optional<double> value = height_number(field);
    if (!value && place.may_name && place.names) {
      *place.names = true;
      value = std::nan("");
    }
    if (!value) {
      const bool name = place.may_name && field.find_first_of("0123456789") == std::string_view::npos;
      throw InputError(
          fmt::format("{}, line {}, column {}: {}{}", place.where, place.line, count, why_no_field(field, separator),
                      name ? "; names of columns are left out with `map table` or `tif table` index" : ""));
    }
    values.push_back(*value);
  }
  return count;
}

/// Whether a comment before the first row has a second field that begins with '#', as a row of markers that are not
/// known.
bool starts_like_markers(std::string_view comment) {
  for (const char* next : {",#", ";#", "\t#"}) {
    if (comment.find(next) != std::string_view::npos) return true;
  }
  return false;
}

/// Whether a comment between rows would be a row of so many fields without its '#': a row that was struck out, or whose
/// first value is a marker that is not known. Leaving it out would shift the map.
bool is_a_row(std::string_view comment, char separator, Index cols) {
  comment.remove_prefix(1);
  Index count = 0;
  bool more = true, numbers = true;
  for (std::string_view field; next_field(comment, more, separator, field); ++count) {
    field = trim(field);
    numbers = numbers && (count == 0 || field.starts_with('#') || height_number(field));
  }
  return cols > 1 && count == cols && numbers;
}

}  // namespace

MapSource parse_matrix_text(std::string_view text, const std::string& where, bool* named_columns) {
  MapSource matrix;
  TextHeader header(where);
  char separator = ' ';
  long first_line = 0, blank_line = 0;  // the latter: between rows, 0 = none
  for (TextLines lines(text); lines.next();) {
    // A trailing tab is an empty field where tabs separate, so only blanks are trimmed here.
    std::string_view row = lines.line();
    const std::string_view trimmed = trim(row);
    // A line of tabs alone is a row without data where tabs separate; skipping it would shift the map.
    const bool tabs_alone = trimmed.empty() && row.find('\t') != std::string_view::npos;
    if (trimmed.empty() && !(tabs_alone && (separator == '\t' || matrix.rows == 0))) {
      if (matrix.rows > 0 && blank_line == 0) blank_line = lines.number();
      continue;
    }
    if (is_text_comment(trimmed)) {
      if (matrix.rows > 0 && is_a_row(trimmed, separator, matrix.cols)) {
        throw InputError(
            fmt::format("{}, line {}: {} has as many numbers as a row, but begins with '#'; a row, or a comment before "
                        "the first row or without numbers, is required",
                        where, lines.number(), in_quotes(trimmed)));
      }
      if (matrix.rows == 0 && starts_like_markers(trimmed)) {
        throw InputError(fmt::format(
            "{}, line {}: {} begins with '#' more than once; a comment, or a row of numbers with nan for no data, is "
            "required",
            where, lines.number(), in_quotes(trimmed)));
      }
      header.read_comment(trimmed, lines.number());
      continue;
    }
    if (blank_line > 0) {
      throw InputError(fmt::format(
          "{}, line {}: blank, and rows follow in line {}: is this a second block? One block of rows without "
          "blank lines is required",
          where, blank_line, lines.number()));
    }
    if (matrix.rows == 0) {
      separator = separator_of(tabs_alone ? row : trimmed);
      // One value between tabs, as at the top of a round part.
      if (separator == ' ' && trimmed.find(' ') == std::string_view::npos && row.find('\t') != std::string_view::npos)
        separator = '\t';
      first_line = lines.number();
    }
    if (separator == ' ') row = trimmed;
    const RowPlace place{where, lines.number(), matrix.rows == 0, named_columns};
    const Index count = read_row(row, separator, place, matrix.values);
    if (matrix.rows == 0) {
      matrix.cols = count;
    } else if (count != matrix.cols) {
      throw InputError(fmt::format("{}, line {}: {}; line {} has {} and every row must have as many", where,
                                   lines.number(), counted(count, "column"), first_line, matrix.cols));
    }
    ++matrix.rows;
  }
  if (matrix.rows == 0) throw InputError(fmt::format("{}: no row of numbers; a matrix of heights is required", where));
  matrix.header = header.header_of_matrix(matrix.rows, matrix.cols);
  matrix.pitch_hint = matrix.cols == 3 ? "; or, if its lines are x y z, name it .xyz or begin it with a line 'x y z'"
                                       : ", or begin the file with a line '# pitch_mm: 0.1'";
  return matrix;
}

std::string matrix_text(const HeightMap& map, char separator) {
  fmt::memory_buffer buffer;
  auto out = std::back_inserter(buffer);
  fmt::format_to(out, "{}# rows: row 1 = smallest y; columns: column 1 = smallest x\n", header_lines(map));
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      if (col > 0) buffer.push_back(separator);
      const double value = map.at(row, col);
      if (std::isnan(value)) {
        fmt::format_to(out, "nan");
      } else {
        fmt::format_to(out, "{}", value);
      }
    }
    buffer.push_back('\n');
  }
  return fmt::to_string(buffer);
}

}  // namespace dwell
