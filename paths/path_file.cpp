#include "paths/path_file.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/poll.h"
#include "core/base/text_lines.h"
#include "core/base/units.h"
#include "core/base/whole_file.h"
#include "core/formats/path_remark.h"
#include "core/map/unit_mention.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

/// Text of a file as it may be shown in a message: short and printable.
std::string printable_text(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string out(text.substr(0, kLongest));
  for (char& c : out) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.size() > kLongest ? out + "..." : out;
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

class PathFileReader {
 public:
  explicit PathFileReader(std::string name) : name_(std::move(name)) {}

  ToolPath read(std::string_view text, const Progress& progress) {
    Poll poll(progress, 8192);
    text = without_byte_order_mark(text);
    while (!text.empty()) {
      poll.step();
      const std::size_t end = text.find('\n');
      ++line_number_;
      take_line(trim(text.substr(0, end)));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    if (columns_ == 0) {
      throw InputError(fmt::format("{}: no header line; the first line must name columns x_mm,y_mm[,lift]", name_));
    }
    if (path_.points.empty()) {
      throw InputError(fmt::format("{}: no dwell point follows the header; at least one is required", name_));
    }
    path_.kind = "file";
    path_.lifted.front() = 1;
    return std::move(path_);
  }

 private:
  void take_line(std::string_view line) {
    if (line.empty()) return;
    if (line.front() == '#' && !starts_with_spreadsheet_error(line)) return check_comment(line.substr(1));
    split_fields(line, fields_);
    if (columns_ == 0) {
      take_header(line);
    } else {
      take_point();
    }
  }

  /// A comment that names a unit, a scale or an origin is not skipped: coordinates are mm in the map's system. The
  /// words of a feed table, which may be read as a path, say the same.
  void check_comment(std::string_view comment) const {
    const std::size_t end = comment.find_first_of(":=");
    if (end != std::string_view::npos && is_name_of_file(trim(comment.substr(0, end)))) return;
    if (const auto unit = find_other_unit(comment)) {
      throw InputError(
          fmt::format("{}: line {}: \"{}\" in the comment \"{}\" looks like another unit; accepted: x_mm and y_mm in "
                      "mm, or the comment without a unit",
                      name_, line_number_, printable_text(*unit), printable_text(trim(comment))));
    }
    if (const auto other = find_other_places(comment); other && !comment.starts_with(" option:")) {
      throw InputError(
          fmt::format("{}: line {}: the comment \"{}\" looks like {}; accepted: x_mm and y_mm in mm in the "
                      "system of the map, or the comment left out",
                      name_, line_number_, printable_text(trim(comment)), *other));
    }
    if (end == std::string_view::npos) return;
    const std::string key = lower_case(trim(comment.substr(0, end)));
    const std::string_view value = trim(comment.substr(end + 1));
    const bool unit = key.find("unit") != std::string::npos;
    const bool place = key.find("origin") != std::string::npos || key.find("offset") != std::string::npos ||
                       key.find("scale") != std::string::npos;
    const bool says_mm = known_length_unit(value) == units::kNmPerMm || value.starts_with("x_mm and y_mm mm");
    if (!place && (!unit || says_mm)) return;
    throw InputError(
        fmt::format("{}: line {}: comment \"{}\" may change what the coordinates mean; accepted: mm, in the "
                    "map's coordinates",
                    name_, line_number_, printable_text(trim(comment))));
  }

  /// Lines of our feed tables whose value is a name that a user gave.
  static bool is_name_of_file(std::string_view key) { return key == "input" || key == "path"; }

  /// A column that is named almost as one that is read would be skipped in silence.
  void refuse_almost(std::string_view column) const {
    const std::string name = lower_case(column);
    if (column == "lift" || (name.find("lift") == std::string::npos && name != "x_mm" && name != "y_mm")) return;
    if (column == "x_mm" || column == "y_mm") return;
    throw InputError(
        fmt::format("{}: line {}: column \"{}\"; accepted: x_mm, y_mm, lift, exactly so, and columns of "
                    "other meaning",
                    name_, line_number_, printable_text(column)));
  }

  void take_header(std::string_view line) {
    columns_ = fields_.size();
    for (std::size_t i = 0; i < columns_; ++i) {
      refuse_almost(fields_[i]);
      if (fields_[i] == "x_mm") assign(x_, i);
      if (fields_[i] == "y_mm") assign(y_, i);
      if (fields_[i] == "lift") assign(lift_, i);
    }
    if (!x_ || !y_) {
      throw InputError(fmt::format("{}: line {}: header \"{}\"; it must name columns x_mm,y_mm[,lift]", name_,
                                   line_number_, printable_text(line)));
    }
  }

  void assign(std::optional<std::size_t>& column, std::size_t i) const {
    if (column) {
      throw InputError(
          fmt::format("{}: line {}: column {} is named twice; required once", name_, line_number_, fields_[i]));
    }
    column = i;
  }

  void take_point() {
    if (fields_.size() != columns_) {
      throw InputError(fmt::format("{}: line {} has {}; the header has {}", name_, line_number_,
                                   counted(fields_.size(), "column"), columns_));
    }
    path_.points.push_back({coordinate(*x_, "x_mm"), coordinate(*y_, "y_mm")});
    path_.lifted.push_back(lift_ && flag(*lift_) ? 1 : 0);
  }

  double coordinate(std::size_t column, const char* name) const {
    const std::optional<double> value = parse_number(fields_[column]);
    if (!value || !std::isfinite(*value)) refuse(column, name, "a finite number");
    return *value;
  }

  bool flag(std::size_t column) const {
    const std::optional<double> value = parse_number(fields_[column]);
    if (!value || !(*value == 0.0 || *value == 1.0)) refuse(column, "lift", "0 or 1");
    return *value == 1.0;
  }

  [[noreturn]] void refuse(std::size_t column, const char* name, const char* required) const {
    throw InputError(fmt::format("{}: line {}: {} = \"{}\"; required: {}", name_, line_number_, name,
                                 printable_text(fields_[column]), required));
  }

  std::string name_;
  std::size_t line_number_ = 0;
  std::size_t columns_ = 0;  // of the header; 0 = not read yet
  std::optional<std::size_t> x_, y_, lift_;
  std::vector<std::string_view> fields_;
  ToolPath path_;
};

}  // namespace

ToolPath parse_path_text(std::string_view text, const std::string& name, const Progress& progress) {
  return PathFileReader(name).read(text, progress);
}

ToolPath read_path_file(const std::filesystem::path& file, const Progress& progress) {
  return parse_path_text(read_whole_file(file), file.string(), progress);
}

}  // namespace dwell
