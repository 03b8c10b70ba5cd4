#include "core/formats/xyz_columns.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/word_list.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

struct NamedColumn {
  std::string name, unit;
  bool unit_apart = false;
};

bool parts_names(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '"' || c == '\''; }

/// Cuts a name, or a unit in brackets, off the line.
std::string take_column_word(std::string_view& rest) {
  std::size_t size = 0;
  if (rest.front() == '(' || rest.front() == '[') {
    size = std::min(rest.find(rest.front() == '(' ? ')' : ']'), rest.size() - 1) + 1;
  } else {
    while (size < rest.size() && !parts_names(rest[size]) && rest[size] != '(' && rest[size] != '[') ++size;
  }
  std::string word(rest.substr(0, size));
  rest.remove_prefix(size);
  return word;
}

/// "z_um" and "z/um" hold their unit.
NamedColumn named_column(const std::string& word) {
  const std::size_t at = word.find_first_of("_/");
  if (at == std::string::npos) return {word, "", false};
  return {word.substr(0, at), word.substr(at + 1), false};
}

/// The words of the line that names columns, each with whether a blank or a comma stands before it.
std::vector<std::pair<std::string, bool>> column_words_of(std::string_view line) {
  std::vector<std::pair<std::string, bool>> words;
  bool apart = false;
  while (!line.empty()) {
    if (parts_names(line.front())) {
      line.remove_prefix(1);
      apart = true;
      continue;
    }
    words.emplace_back(take_column_word(line), apart);
    apart = false;
  }
  return words;
}

/// The columns of the line; a unit that stands alone, in brackets or not, is that of the column before. "in" is the
/// inch unless a unit follows ("x in mm").
std::vector<NamedColumn> named_columns_of(std::string_view line) {
  std::vector<NamedColumn> columns;
  const auto words = column_words_of(line);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto& [word, apart] = words[i];
    if (word == "in" && i + 1 < words.size() && words[i + 1].first != "in" && known_value_unit(words[i + 1].first))
      continue;
    const bool bracketed = word.front() == '(' || word.front() == '[';
    const bool alone = !columns.empty() && columns.back().unit.empty() && known_value_unit(word);
    if (!bracketed && !alone) {
      columns.push_back(named_column(word));
      continue;
    }
    if (columns.empty() || !columns.back().unit.empty()) return {};
    columns.back().unit = bracketed ? std::string(trim(std::string_view(word).substr(1, word.size() - 2))) : word;
    columns.back().unit_apart = apart;
  }
  return columns;
}

/// Words for the place of a point, and others that columns of points have.
constexpr std::array<std::string_view, 21> kPlaceColumns{"x",   "y",    "z",    "r",     "rho",    "theta", "phi",
                                                         "row", "rows", "col",  "cols",  "column", "i",     "j",
                                                         "u",   "v",    "east", "north", "up",     "lon",   "lat"};
constexpr std::array<std::string_view, 20> kOtherColumns{
    "height", "heights", "h",       "dz",   "sag",   "value",   "rate",      "index", "id",    "sigma",
    "error",  "weight",  "weights", "mask", "valid", "quality", "intensity", "pos",   "point", "line"};

std::string_view uncommented(std::string_view line) {
  line = trim(line);
  while (!line.empty() && line.front() == '#') line = trim(line.substr(1));
  return line;
}

}  // namespace

bool names_other_columns(std::string_view line) {
  std::size_t places = 0, names = 0, units = 0;
  for (const auto& [word, apart] : column_words_of(lower_case(uncommented(line)))) {
    if (known_value_unit(word)) {
      ++units;
    } else if (word.front() != '(' && word.front() != '[') {
      const std::string name = named_column(word).name;
      if (!is_among(name, kPlaceColumns) && !is_among(name, kOtherColumns)) return false;
      ++names;
      places += is_among(name, kPlaceColumns) ? 1 : 0;
    }
  }
  return names == 0 ? units > 0 : places > 1;
}

std::optional<XyzColumns> parse_xyz_columns(std::string_view line) {
  std::vector<NamedColumn> columns = named_columns_of(lower_case(uncommented(line)));
  if (columns.size() != 3 || columns[0].name != "x" || columns[1].name != "y") return std::nullopt;
  constexpr std::array<std::string_view, 8> kThird{"z", "height", "heights", "h", "dz", "sag", "value", "rate"};
  if (!is_among(columns[2].name, kThird)) return std::nullopt;
  // "x, y in mm, z in nm": the unit behind y is that of both.
  if (columns[0].unit.empty() && columns[1].unit_apart) columns[0].unit = columns[1].unit;
  const bool apart = columns[0].unit.empty() && columns[1].unit.empty() && columns[2].unit_apart;
  return XyzColumns{{columns[0].unit, columns[1].unit, columns[2].unit}, apart};
}

}  // namespace dwell
