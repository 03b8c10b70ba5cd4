#include "core/formats/header_statements.h"

#include <algorithm>
#include <array>

#include "core/base/number_text.h"
#include "core/base/word_list.h"
#include "core/formats/map_terms.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

bool names_axes_alone(std::string_view text) { return text.find_first_not_of("xyzXYZ, \t") == std::string_view::npos; }

/// "Height [um]", "heights in um", "x (mm)", "coordinates in mm", "all in m": a name that holds its unit.
bool is_caption(const HeaderKey& key) {
  const bool values = are_value_words(key.words) || (key.words.empty() && key.axis == 'z');
  if (key.words.empty() && (key.axis == 'x' || key.axis == 'y')) return key.length.has_value();
  if (speaks_of_coordinates(key) || speaks_of_everything(key)) return key.length.has_value();
  return values && key.axis != 'x' && key.axis != 'y' && (!key.unit.empty() || is_optical_unit(key.remark));
}

/// Where the next of the separators stands outside brackets, or the end.
std::size_t next_separator(std::string_view text, std::size_t from, std::string_view separators) {
  int depth = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    if (depth <= 0 && separators.find(c) != std::string_view::npos) return i;
  }
  return text.size();
}

}  // namespace

std::vector<std::string> header_statements(std::string_view text) {
  std::vector<std::string> statements;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = next_separator(text, begin, ";|\t,");
    const std::string_view part = text.substr(begin, end - begin), bare = trim(part);
    const bool named = part.find_first_of(":=") != std::string_view::npos;
    const bool after_comma = begin > 0 && text[begin - 1] == ',';
    const bool number = !bare.empty() && std::string_view("0123456789+-.").find(bare.front()) != std::string_view::npos;
    const bool after_axes = !statements.empty() && names_axes_alone(statements.back());
    const bool own = after_comma ? named : !number;
    if (statements.empty() || (own && !after_axes)) {
      statements.emplace_back(bare);
    } else {
      statements.back() += text[begin - 1];
      statements.back() += part;
    }
    begin = end + 1;
  }
  return statements;
}

std::vector<HeaderKey> header_captions(std::string_view text) {
  std::vector<HeaderKey> keys;
  std::string caption;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = next_separator(text, begin, ",");
    caption += (caption.empty() ? "" : ",") + std::string(text.substr(begin, end - begin));
    begin = end + 1;
    if (names_axes_alone(caption)) continue;
    keys.push_back(parse_header_key(caption));
    if (!is_caption(keys.back())) return {};
    caption.clear();
  }
  return caption.empty() ? keys : std::vector<HeaderKey>();
}

bool speaks_of_coordinates(const HeaderKey& key) {
  constexpr std::array<std::string_view, 8> kWords{"coordinates", "coords",      "coordinate", "positions",
                                                   "koordinaten", "coordonnees", "laterals",   "lateral"};
  return key.words.size() == 1 && key.axis != 'z' && is_among(key.stem, kWords);
}

bool speaks_of_everything(const HeaderKey& key) {
  const std::string shown = fold_letters(key.shown);
  return key.axis == 0 && (key.stem == "everything" || key.stem == "alles" || key.stem == "tout" ||
                           (key.words.empty() && (shown.starts_with("all") || shown.starts_with("tous"))));
}

bool is_optical_unit(std::string_view text) {
  constexpr std::array<std::string_view, 9> kWords{"mrad",   "rad",   "radian",  "radians", "urad",
                                                   "counts", "count", "degrees", "lsb"};
  if (is_wave_unit(text)) return true;
  std::string word = lower_case(trim(text));
  if (word.size() > 2 && (word.front() == '(' || word.front() == '[')) word = word.substr(1, word.size() - 2);
  return is_among(word, kWords);
}

bool holds_a_length(std::string_view text) {
  const auto words = words_of(text);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const auto alone = parse_header_lengths(words[i], 1);
    if (alone && alone->length) return true;
    if (alone && i + 1 < words.size() && known_length_unit(words[i + 1])) return true;
  }
  return false;
}

}  // namespace dwell
