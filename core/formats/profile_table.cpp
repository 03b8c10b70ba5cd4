#include "core/formats/profile_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/text_lines.h"
#include "core/formats/file_kind.h"
#include "core/formats/remark_guard.h"
#include "core/formats/remark_words.h"
#include "core/formats/slope_unit.h"
#include "core/formats/text_comment.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

enum class ProfileSeparator { Semicolon, Blank, Comma };

std::vector<std::string_view> fields_of(std::string_view line, ProfileSeparator separator) {
  std::vector<std::string_view> fields;
  if (separator != ProfileSeparator::Blank) {
    for (const std::string_view field : split(line, separator == ProfileSeparator::Comma ? ',' : ';'))
      fields.push_back(trim(field));
    while (!fields.empty() && fields.back().empty()) fields.pop_back();
    return fields;
  }
  constexpr std::string_view kBlanks = " \t\f\v";
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    if (line.empty()) return fields;
    fields.push_back(line.substr(0, line.find_first_of(kBlanks)));
    line.remove_prefix(fields.back().size());
  }
}

/// How a line of two or more numbers is separated; nothing of any other line.
std::optional<ProfileSeparator> profile_separator(std::string_view line) {
  for (const ProfileSeparator separator :
       {ProfileSeparator::Semicolon, ProfileSeparator::Blank, ProfileSeparator::Comma}) {
    const auto fields = fields_of(line, separator);
    const bool numbers = std::all_of(fields.begin(), fields.end(), [](auto f) { return finite_number(f).has_value(); });
    if (fields.size() >= 2 && numbers) return separator;
  }
  return std::nullopt;
}

/// "1,5 2,25" and "1,5;2,25": numbers if the commas were points, with one comma at least.
bool has_comma_numbers(std::string_view line) {
  const ProfileSeparator separator =
      line.find(';') != std::string_view::npos ? ProfileSeparator::Semicolon : ProfileSeparator::Blank;
  const auto fields = fields_of(line, separator);
  bool comma = false;
  for (const std::string_view field : fields) {
    std::string number(field);
    if (const std::size_t at = number.find(','); at != std::string::npos) {
      number[at] = '.';
      comma = comma || at + 1 < number.size();
    }
    if (!finite_number(number)) return false;
  }
  return fields.size() >= 2 && comma;
}

struct ProfileLine {
  std::string_view text;
  long number;
};

/// Reads the lines one after the other.
class ProfileTableReader {
 public:
  explicit ProfileTableReader(const std::string& where) : where_(where) {}

  void take_comment(ProfileLine line) { remarks_.push_back({bare_comment(line.text), line.number}); }

  void take(ProfileLine line) {
    if (!separator_) {
      separator_ = profile_separator(line.text);
      if (!separator_) {
        header_.push_back(line);
        return;
      }
      table_.columns = fields_of(line.text, *separator_).size();
      for (const ProfileLine& before : header_) refuse_broken(before);
    }
    take_row(line);
  }

  ProfileTable finish() {
    if (!separator_) refuse_no_table();
    for (const ProfileLine& line : header_) remarks_.push_back({bare_comment(line.text), line.number});
    for (const ProfileLine& remark : remarks_) {
      if (!take_names(remark) && !take_statement(remark)) guard(remark);
    }
    return std::move(table_);
  }

 private:
  std::string place(long line) const { return fmt::format("{}, line {}", where_, line); }

  /// A line before the table that begins with a number and has as many fields is a damaged row, no header.
  void refuse_broken(ProfileLine line) const {
    if (has_comma_numbers(line.text)) refuse_commas(line);
    const auto fields = fields_of(line.text, *separator_);
    if (fields.size() == table_.columns && finite_number(fields[0])) row_of(fields, line.number);
  }

  [[noreturn]] void refuse_commas(ProfileLine line) const {
    throw InputError(fmt::format("{}: {} has decimal commas; they are not accepted, write points", place(line.number),
                                 in_quotes(line.text)));
  }

  [[noreturn]] void refuse_no_table() const {
    for (const ProfileLine& line : header_) {
      if (has_comma_numbers(line.text)) refuse_commas(line);
    }
    throw InputError(fmt::format(
        "{}: no line of two numbers or more; required: lines of a place and a slope or height, separated by "
        "blanks, tabs, semicolons or commas",
        where_));
  }

  std::vector<double> row_of(const std::vector<std::string_view>& fields, long line) const {
    std::vector<double> row;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const std::optional<double> number = finite_number(fields[k]);
      if (!number) {
        const bool missing = height_number(fields[k]).has_value();
        throw InputError(fmt::format("{}, column {}: {} {}", place(line), k + 1, in_quotes(fields[k]),
                                     missing ? "is no data; leave the line out" : "is not a number"));
      }
      row.push_back(*number);
    }
    return row;
  }

  void take_row(ProfileLine line) {
    const auto fields = fields_of(line.text, *separator_);
    if (fields.size() != table_.columns) {
      if (has_comma_numbers(line.text)) refuse_commas(line);
      throw InputError(
          fmt::format("{}: {} has {} fields, the first line of numbers has {}; the same number is required",
                      place(line.number), in_quotes(line.text), fields.size(), table_.columns));
    }
    if (*separator_ != ProfileSeparator::Comma && has_comma_numbers(line.text)) refuse_commas(line);
    table_.rows.push_back(row_of(fields, line.number));
    table_.lines.push_back(line.number);
  }

  bool take_names(ProfileLine remark) {
    std::vector<ProfileColumn> names = parse_profile_columns(remark.text, table_.columns);
    if (names.empty()) return false;
    if (!table_.names.empty()) {
      throw InputError(fmt::format("{}: the columns are named here and on line {}; once is required",
                                   place(remark.number), table_.names_line));
    }
    table_.names = std::move(names);
    table_.names_line = remark.number;
    return true;
  }

  /// "unit: mm, urad", "slope unit = urad".
  bool take_statement(ProfileLine remark) {
    const std::size_t mark = remark.text.find_first_of(":=");
    if (mark == std::string_view::npos) return false;
    const std::vector<std::string> key = profile_words(remark.text.substr(0, mark));
    const auto has = [&key](std::string_view word) { return std::find(key.begin(), key.end(), word) != key.end(); };
    if (!has("unit") && !has("units")) return false;
    const std::string_view value = remark.text.substr(mark + 1);
    const auto parts = split(value, value.find(';') != std::string_view::npos ? ';' : ',');
    const ProfileColumn named{"", key, ""};
    if (parts.size() == 2 && known_length_unit(parts[0]) &&
        (known_length_unit(parts[1]) || known_slope_unit(parts[1]))) {
      set_unit(table_.place_unit, parts[0], remark.number);
      set_unit(table_.value_unit, parts[1], remark.number);
    } else if (parts.size() == 1 && named.is_place() && known_length_unit(value)) {
      set_unit(table_.place_unit, value, remark.number);
    } else if (parts.size() == 1 && (known_slope_unit(value) || (named.is_height() && known_length_unit(value)))) {
      set_unit(table_.value_unit, value, remark.number);
    } else {
      add_unclear(remark);
    }
    return true;
  }

  void set_unit(std::optional<std::string>& unit, std::string_view value, long line) const {
    const std::string text(trim(value));
    if (unit && *unit != text) {
      throw InputError(fmt::format("{}: the unit is {} here and {} before; one is required", place(line),
                                   in_quotes(text), in_quotes(*unit)));
    }
    unit = text;
  }

  /// What no rule has understood may still speak of the unit, a factor or missing values.
  void guard(ProfileLine remark) {
    using About = UnclearStatement::About;
    for (const UnclearStatement& statement : unclear_remarks(remark.text, place(remark.number))) {
      if (statement.about == About::NoData) {
        throw InputError(
            fmt::format("{}: {} looks like a value for no data; leave such lines of the table out, and this "
                        "remark",
                        place(remark.number), in_quotes(remark.text)));
      }
      if (statement.about == About::Unit || statement.about == About::Factor || statement.about == About::Wavefront)
        add_unclear(remark);
    }
    if (speaks_of_slope_unit(remark.text)) add_unclear(remark);
  }

  void add_unclear(ProfileLine remark) {
    table_.unclear.push_back(fmt::format("{}: {} looks like a unit, a factor or a sign of the values",
                                         place(remark.number), in_quotes(remark.text)));
  }

  /// A unit of slope that is not that of a number: "slopes in mrad", but not "residual slope [urad]: 0.5".
  static bool speaks_of_slope_unit(std::string_view remark) {
    const std::vector<RemarkWord> words = remark_words(remark);
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (!known_slope_unit(words[i].text)) continue;
      const bool of_before = i > 0 && words[i - 1].number;
      const bool of_next = i + 1 < words.size() && words[i + 1].number;
      if (!of_before && !of_next) return true;
    }
    return false;
  }

  const std::string& where_;
  std::optional<ProfileSeparator> separator_;
  std::vector<ProfileLine> header_, remarks_;
  ProfileTable table_;
};

}  // namespace

ProfileTable read_profile_table(std::string_view text, const std::string& where) {
  if (const std::string kind = kind_of_binary(text); !kind.empty())
    throw InputError(fmt::format("{}: {}; a text of numbers is required", where, kind));
  ProfileTableReader reader(where);
  for (TextLines lines(text); lines.next();) {
    const std::string_view line = trim(lines.line());
    if (line.empty()) continue;
    if (is_text_comment(line) || line.front() == '%') {
      const std::size_t from = line.front() == '%' ? std::min(line.find_first_not_of("% "), line.size()) : 0;
      reader.take_comment({line.substr(from), lines.number()});
    } else {
      reader.take({line, lines.number()});
    }
  }
  return reader.finish();
}

}  // namespace dwell
