#include "core/formats/profile_columns.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/number_text.h"
#include "core/base/word_list.h"
#include "core/formats/map_terms.h"
#include "core/formats/slope_unit.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

bool is_profile_unit(std::string_view text) { return known_length_unit(text) || known_slope_unit(text); }

template <std::size_t Size>
bool any_word(const std::vector<std::string>& words, const std::array<std::string_view, Size>& known) {
  return std::any_of(words.begin(), words.end(), [&known](const std::string& word) { return is_among(word, known); });
}

/// Takes what stands in brackets out of a name, each pair in turn; the first known unit counts, else the first text.
std::string take_bracketed(std::string& name) {
  std::string unit;
  while (true) {
    const std::size_t open = name.find_first_of("[(");
    if (open == std::string::npos) return unit;
    const std::size_t close = name.find(name[open] == '[' ? ']' : ')', open);
    const std::size_t end = std::min(close, name.size());
    const std::string inside(trim(std::string_view(name).substr(open + 1, end - open - 1)));
    if (unit.empty() || (!is_profile_unit(unit) && is_profile_unit(inside))) unit = inside;
    name.replace(open, std::min(end + 1, name.size()) - open, " ");
  }
}

/// The unit behind '_', '/', ',' or "in" at the end of a name: "x_mm", "slope/urad", "x in mm". Cuts it off.
std::string take_trailing(std::string& name) {
  for (const std::string_view mark : {"_", "/", ",", " in ", " "}) {
    const std::size_t at = mark == "/" ? name.find(mark) : name.rfind(mark);
    if (at == std::string::npos) continue;
    std::string unit(trim(std::string_view(name).substr(at + mark.size())));
    if (!is_profile_unit(unit)) continue;
    name.resize(at);
    return unit;
  }
  return "";
}

ProfileColumn column_of(std::string_view text) {
  ProfileColumn column{std::string(trim(text)), {}, {}};
  std::string name = column.shown;
  name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c == '"' || c == '\''; }), name.end());
  column.unit = take_bracketed(name);
  name = std::string(trim(name));
  if (column.unit.empty()) column.unit = take_trailing(name);
  column.words = profile_words(name);
  return column;
}

/// Fields between separators outside of brackets; of blanks and tabs, runs count as one.
std::vector<std::string> split_outside_brackets(std::string_view line, std::string_view separators, bool runs) {
  std::vector<std::string> fields(1);
  int depth = 0;
  for (const char c : line) {
    if (c == '[' || c == '(') ++depth;
    if ((c == ']' || c == ')') && depth > 0) --depth;
    if (depth > 0 || separators.find(c) == std::string_view::npos) {
      fields.back() += c;
    } else if (!runs || !fields.back().empty()) {
      fields.emplace_back();
    }
  }
  while (fields.size() > 1 && trim(fields.back()).empty()) fields.pop_back();
  return fields;
}

/// A unit in brackets that stands apart belongs to the name before it: "x [mm] slope [urad]".
std::vector<std::string> with_units_joined(const std::vector<std::string>& fields) {
  std::vector<std::string> joined;
  for (const std::string& field : fields) {
    if (!joined.empty() && !field.empty() && (field.front() == '[' || field.front() == '(')) {
      joined.back() += " " + field;
    } else {
      joined.push_back(field);
    }
  }
  return joined;
}

std::vector<ProfileColumn> columns_of(const std::vector<std::string>& fields, std::size_t count) {
  if (fields.size() != count) return {};
  std::vector<ProfileColumn> columns;
  columns.reserve(count);
  for (const std::string& field : fields) columns.push_back(column_of(field));
  const bool place = std::any_of(columns.begin(), columns.end(), [](const auto& c) { return c.is_place(); });
  const bool value =
      std::any_of(columns.begin(), columns.end(), [](const auto& c) { return c.is_slope() || c.is_height(); });
  return place && value ? columns : std::vector<ProfileColumn>{};
}

}  // namespace

std::vector<std::string> profile_words(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : fold_letters(name)) {
    const bool part = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (part) {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool ProfileColumn::is_place() const {
  constexpr std::array<std::string_view, 12> kPlaces{"x",        "xpos",       "xposition", "pos",
                                                     "position", "positions",  "abscissa",  "abszisse",
                                                     "abscisse", "coordinate", "distance",  "place"};
  return any_word(words, kPlaces) && !is_slope() && !is_height();
}

bool ProfileColumn::is_slope() const {
  constexpr std::array<std::string_view, 9> kSlopes{"slope",  "slopes",   "steigung", "neigung", "pente",
                                                    "pentes", "gradient", "tilt",     "yslope"};
  return any_word(words, kSlopes);
}

bool ProfileColumn::is_height() const {
  constexpr std::array<std::string_view, 11> kHeights{"height", "heights", "heigth",  "hight",    "z",        "sag",
                                                      "hoehe",  "hoehen",  "hauteur", "hauteurs", "elevation"};
  return any_word(words, kHeights) && !is_slope();
}

std::vector<ProfileColumn> parse_profile_columns(std::string_view line, std::size_t count) {
  if (line.find_first_of("=:") != std::string_view::npos) return {};
  for (const std::string_view separators : {";", "\t", ","}) {
    auto columns = columns_of(split_outside_brackets(line, separators, false), count);
    if (!columns.empty()) return columns;
  }
  return columns_of(with_units_joined(split_outside_brackets(line, " \t", true)), count);
}

}  // namespace dwell
