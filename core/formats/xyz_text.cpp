#include "core/formats/xyz_text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr double kFarthest = 1e12;  // [mm]; nothing of a part lies there, and differences of coordinates stay finite

bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';'; }

/// The unit suffix of a column name: "z_um" -> "um", "z" -> "". Nothing if the name is another one.
std::optional<std::string> unit_of_column(const std::string& name, std::string_view stem) {
  if (!name.starts_with(stem)) return std::nullopt;
  if (name.size() == stem.size()) return "";
  if (name[stem.size()] != '_') return std::nullopt;
  return name.substr(stem.size() + 1);
}

/// Units of the columns x, y, z of a line that names them.
std::optional<std::array<std::string, 3>> column_units(std::string_view line) {
  line = trim(line);
  while (line.starts_with('#')) line = trim(line.substr(1));
  std::vector<std::string> names(1);
  for (const char c : lower_case(line)) {
    if (!is_separator(c)) {
      names.back() += c;
    } else if (!names.back().empty()) {
      names.emplace_back();
    }
  }
  if (names.size() != 3) return std::nullopt;
  const auto x = unit_of_column(names[0], "x"), y = unit_of_column(names[1], "y");
  auto z = unit_of_column(names[2], "z");
  if (!z) z = unit_of_column(names[2], "height");
  if (!x || !y || !z) return std::nullopt;
  return std::array{*x, *y, *z};
}

void take_column_units(const std::array<std::string, 3>& units, const std::string& place, MapHeader& header) {
  for (const std::string& lateral : {units[0], units[1]}) {
    if (!lateral.empty() && lateral != "mm") {
      throw InputError(fmt::format("{}: x or y in '{}'; both must be in mm", place, lateral));
    }
  }
  if (units[2].empty()) return;
  if (header.unit && *header.unit != units[2]) {
    throw InputError(
        fmt::format("{}: z in '{}', but unit = '{}' above; they must agree", place, units[2], *header.unit));
  }
  header.unit = units[2];
}

/// Cuts a number of at most kFarthest and the separator after it (blanks around at most one comma or semicolon) off the
/// line.
bool take_coordinate(std::string_view& rest, double& value) {
  if (rest.size() > 1 && rest[0] == '+' && rest[1] != '-') rest.remove_prefix(1);
  const char* const end = rest.data() + rest.size();
  const auto [stop, error] = std::from_chars(rest.data(), end, value);
  if (error != std::errc() || !(std::abs(value) <= kFarthest) || stop == end || !is_separator(*stop)) return false;
  rest = trim(std::string_view(stop, static_cast<std::size_t>(end - stop)));
  if (!rest.empty() && (rest.front() == ',' || rest.front() == ';')) rest = trim(rest.substr(1));
  return true;
}

XyzPoint read_point(std::string_view line, const std::string& where, long number) {
  XyzPoint point;
  point.line = number;
  std::string_view rest = line;
  if (!take_coordinate(rest, point.position.x) || !take_coordinate(rest, point.position.y)) {
    throw InputError(
        fmt::format("{}, line {}: '{}' is not a point; x y z separated by blanks, commas, semicolons or "
                    "tabs is required, x and y in mm, at most {} mm from 0",
                    where, number, line.substr(0, 60), kFarthest));
  }
  const std::optional<double> height = height_number(rest);
  if (!height) throw InputError(fmt::format("{}, line {}, column 3: {}", where, number, why_no_height(rest)));
  point.height = *height;
  return point;
}

bool starts_like_number(std::string_view line) {
  const char c = line.front();
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

}  // namespace

bool names_xyz_columns(std::string_view text) {
  for (TextLines lines(text); lines.next();) {
    const std::string_view line = trim(lines.line());
    if (line.empty()) continue;
    if (column_units(line)) return true;
    if (line.front() != '#') return false;
  }
  return false;
}

XyzText parse_xyz_text(std::string_view text, const std::string& where) {
  XyzText xyz;
  for (TextLines lines(text); lines.next();) {
    const std::string_view line = trim(lines.line());
    if (line.empty()) continue;
    const bool comment = line.front() == '#' && !starts_with_spreadsheet_error(line);
    if (comment || (xyz.points.empty() && !starts_like_number(line))) {
      const std::string place = fmt::format("{}, line {}", where, lines.number());
      const auto units = column_units(line);
      if (units) take_column_units(*units, place, xyz.header);
      if (comment && !units) read_header_line(line, place, xyz.header);
      if (comment || units) continue;
    }
    xyz.points.push_back(read_point(line, where, lines.number()));
  }
  if (xyz.points.empty()) throw InputError(fmt::format("{}: no point; lines x y z are required", where));
  return xyz;
}

std::string xyz_text(const HeightMap& map) {
  fmt::memory_buffer buffer;
  auto out = std::back_inserter(buffer);
  fmt::format_to(out, "{}# x_mm y_mm z_{}\n", header_lines(map), unit_of(map.quantity));
  for (Index row = 0; row < map.grid.rows; ++row) {
    for (Index col = 0; col < map.grid.cols; ++col) {
      fmt::format_to(out, "{} {} ", map.grid.x(col), map.grid.y(row));
      const double value = map.at(row, col);
      if (std::isnan(value)) {
        fmt::format_to(out, "nan\n");
      } else {
        fmt::format_to(out, "{}\n", value);
      }
    }
  }
  return fmt::to_string(buffer);
}

}  // namespace dwell
