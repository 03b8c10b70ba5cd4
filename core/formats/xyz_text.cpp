#include "core/formats/xyz_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/base/units.h"
#include "core/formats/text_comment.h"
#include "core/formats/text_header.h"
#include "core/formats/xyz_columns.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr double kFarthest = 1e12;  // [mm]; nothing of a part lies there, and differences of coordinates stay finite

bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';'; }

constexpr double kHugePart = 1000.0;  // mm; few are larger

/// What the line that names the columns says of their units.
void take_columns(const XyzColumns& columns, const std::string& place, TextHeader& header) {
  const auto& [x, y, z] = columns.units;
  if (columns.unit_apart && known_length_unit(z) != known_length_unit("mm")) {
    throw InputError(
        fmt::format("{}: one unit, {}, behind three columns: of z alone, or of all? Name them as 'x_mm y_mm z_um'",
                    place, in_quotes(z)));
  }
  if (!x.empty()) header.take_lateral_unit(x, "x");
  if (!y.empty()) header.take_lateral_unit(y, "y");
  if (x.empty() != y.empty()) {
    throw InputError(fmt::format("{}: only one of x and y has a unit; name the columns as 'x_mm y_mm z_nm'", place));
  }
  if (!z.empty()) header.take_unit(z, "z");
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

/// Whether the line holds three fields, one at least a number with a decimal comma: "0,0 0,5 1,5".
bool has_decimal_commas(std::string_view line) {
  std::size_t fields = 0, commas = 0;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(" \t;"), line.size());
    std::string field(trim(line.substr(0, end)));
    line.remove_prefix(std::min(end + 1, line.size()));
    if (field.empty()) continue;
    const std::size_t comma = field.find(',');
    if (comma != std::string::npos && comma + 1 < field.size()) ++commas, field[comma] = '.';
    if (!finite_number(field)) return false;
    ++fields;
  }
  return fields == 3 && commas > 0;
}

[[noreturn]] void refuse_point(std::string_view line, const std::string& where, long number, bool first) {
  const std::string place = fmt::format("{}, line {}: {}", where, number, in_quotes(line));
  if (has_decimal_commas(line)) {
    throw InputError(fmt::format("{} has decimal commas; they are not accepted, write points", place));
  }
  const bool names = first && line.find_first_of("xyzXYZ") != std::string_view::npos;
  throw InputError(fmt::format(
      "{} is not a point; x y z separated by blanks, commas, semicolons or tabs is required, x and y in mm, at most {} "
      "mm from 0{}",
      place, kFarthest,
      names ? "; a line that names the columns is read as 'x_mm y_mm z_nm' or 'x[mm] y[mm] z[nm]'" : ""));
}

XyzPoint read_point(std::string_view line, const std::string& where, long number, bool first) {
  XyzPoint point;
  point.line = number;
  std::string_view rest = line;
  if (!take_coordinate(rest, point.position.x) || !take_coordinate(rest, point.position.y)) {
    refuse_point(line, where, number, first);
  }
  const std::optional<double> height = height_number(rest);
  if (!height && has_decimal_commas(line)) refuse_point(line, where, number, first);
  if (!height) throw InputError(fmt::format("{}, line {}, column 3: {}", where, number, why_no_height(rest)));
  point.height = *height;
  return point;
}

/// Coordinates in another unit than mm.
void scale_positions(std::vector<XyzPoint>& points, double lateral_nm, const std::string& where) {
  for (XyzPoint& point : points) {
    for (double* v : {&point.position.x, &point.position.y}) {
      *v = *v * lateral_nm / units::kNmPerMm;
      if (std::abs(*v) <= kFarthest) continue;
      throw InputError(fmt::format("{}, line {}: x or y is {} mm; at most {} mm from 0 is required", where, point.line,
                                   *v, kFarthest));
    }
  }
}

/// The longer side of the rectangle about the points [mm].
double extent_of(const std::vector<XyzPoint>& points) {
  Point low = points.front().position, high = low;
  for (const XyzPoint& point : points) {
    low = {std::min(low.x, point.position.x), std::min(low.y, point.position.y)};
    high = {std::max(high.x, point.position.x), std::max(high.y, point.position.y)};
  }
  return std::max(high.x - low.x, high.y - low.y);
}

/// Points are always x, y, z: to take other columns for them would turn the part or take a place for a height.
[[noreturn]] void refuse_columns(std::string_view line, const std::string& where, long number) {
  throw InputError(
      fmt::format("{}, line {}: {} names columns in a way that is not known; x, y and z in this order are "
                  "required, named as 'x_mm y_mm z_nm' or 'x[mm] y[mm] z[nm]'",
                  where, number, in_quotes(line)));
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
    const bool comment = is_text_comment(line);
    if (parse_xyz_columns(comment ? bare_comment(line) : line)) return true;
    if (!comment) return false;
  }
  return false;
}

XyzText parse_xyz_text(std::string_view text, const std::string& where) {
  XyzText xyz;
  TextHeader header(where);
  for (TextLines lines(text); lines.next();) {
    const std::string_view line = trim(lines.line());
    if (line.empty()) continue;
    const bool comment = is_text_comment(line);
    if (comment || (xyz.points.empty() && !starts_like_number(line))) {
      header.set_line(lines.number());
      const std::string_view said = comment ? bare_comment(line) : line;
      const auto columns = parse_xyz_columns(said);
      if (columns) take_columns(*columns, fmt::format("{}, line {}", where, lines.number()), header);
      if (comment && !columns && names_other_columns(said)) refuse_columns(line, where, lines.number());
      if (comment && !columns) header.read_comment(line, lines.number());
      if (comment || columns) continue;
    }
    xyz.points.push_back(read_point(line, where, lines.number(), xyz.points.empty()));
  }
  if (xyz.points.empty()) throw InputError(fmt::format("{}: no point; lines x y z are required", where));
  const double lateral = header.lateral_unit().value_or(units::kNmPerMm);
  if (lateral != units::kNmPerMm) scale_positions(xyz.points, lateral, where);
  xyz.header = header.header_of_points(extent_of(xyz.points) > kHugePart);
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
