#include "core/formats/said_orientation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "core/base/number_text.h"
#include "core/base/word_list.h"
#include "core/formats/map_terms.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

/// The letters and digits of a text in lower case: "Bottom-Up" -> "bottomup".
std::string letters_of(std::string_view text) {
  std::string letters;
  for (const char c : fold_letters(text)) {
    const bool counts = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+';
    if (counts) letters += c;
  }
  return letters;
}

constexpr std::array<std::string_view, 6> kRowWords{"y", "row", "rows", "zeile", "zeilen", "ny"};
constexpr std::array<std::string_view, 8> kColumnWords{"x",       "col",    "cols",    "column",
                                                       "columns", "spalte", "spalten", "nx"};

/// The words of a text that names axes, without units and digits; "yx" and "xy" are two.
std::vector<std::string> axis_words(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  const auto end_word = [&] {
    if (word == "xy" || word == "yx") {
      words.push_back(word.substr(0, 1));
      word.erase(0, 1);
    }
    if (!word.empty() && !(word.size() > 1 && known_length_unit(word))) words.push_back(word);
    word.clear();
  };
  for (const char c : fold_letters(text)) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word += c;
    } else {
      end_word();
    }
  }
  end_word();
  return words;
}

AxisOrder order_of(const std::vector<std::string>& words) {
  constexpr std::array<std::string_view, 2> kUsual{"c", "rowmajor"};
  constexpr std::array<std::string_view, 3> kTurned{"f", "fortran", "columnmajor"};
  if (words.empty()) return AxisOrder::RowsFirst;
  std::string all;
  for (const std::string& word : words) all += word;
  const auto among = [&](const auto& list, const char* order) {
    return is_among(all, list) || (all.ends_with(order) && is_among(all.substr(0, all.size() - 5), list));
  };
  if (among(kUsual, "order")) return AxisOrder::RowsFirst;
  if (among(kTurned, "order") || all == "colmajor") return AxisOrder::ColumnsFirst;
  if (words.size() == 1 && is_among(all, kRowWords)) return AxisOrder::RowsFirst;
  if (words.size() == 1 && is_among(all, kColumnWords)) return AxisOrder::ColumnsFirst;
  if (words.size() < 2) return AxisOrder::Unknown;
  const std::string &first = words[words.size() - 2], &last = words.back();
  if (is_among(first, kRowWords) && is_among(last, kColumnWords)) return AxisOrder::RowsFirst;
  return is_among(first, kColumnWords) && is_among(last, kRowWords) ? AxisOrder::ColumnsFirst : AxisOrder::Unknown;
}

}  // namespace

bool is_usual_orientation(std::string_view text, char axis) {
  constexpr std::array<std::string_view, 27> kUsual{
      "",          "none",        "no",       "false",       "off",          "normal",      "identity",
      "unchanged", "asis",        "bottomup", "lower",       "lowerleft",    "bottom",      "bottomleft",
      "front",     "bottomtotop", "right",    "righthanded", "righthand",    "bottomfirst", "upright",
      "null",      "keine",       "nein",     "aucune",      "fromthefront", "xrightyup"};
  constexpr std::array<std::string_view, 8> kForwards{"+",          "+1",        "1",       "positive",
                                                      "increasing", "ascending", "forward", "normal"};
  constexpr std::array<std::string_view, 5> kUp{"up", "upward", "upwards", "y", "vertical"};
  constexpr std::array<std::string_view, 4> kRight{"right", "totheright", "x", "horizontal"};
  const std::string letters = letters_of(text);
  if (is_among(letters, kUsual) || (axis != 0 && is_among(letters, kForwards))) return true;
  if ((axis == 'y' && is_among(letters, kUp)) || (axis == 'x' && is_among(letters, kRight))) return true;
  const auto number = finite_number(text);
  return number && is_usual_orientation(*number, axis);
}

bool is_usual_orientation(double number, char axis) { return number == 0.0 || (axis != 0 && number == 1.0); }

bool names_a_direction(std::string_view name) {
  const std::string letters = letters_of(name);
  constexpr std::array<std::string_view, 4> kDirections{"axis", "dir", "sign", "sense"};
  return std::any_of(kDirections.begin(), kDirections.end(),
                     [&](std::string_view word) { return letters.find(word) != std::string::npos; });
}

bool names_a_mirroring(std::string_view text) {
  constexpr std::array<std::string_view, 13> kWays{"x",  "y",  "xy", "yes", "true",      "horizontal", "vertical",
                                                   "lr", "ud", "h",  "v",   "leftright", "updown"};
  return is_among(letters_of(text), kWays);
}

std::optional<AxisClaim> read_axis_claim(std::string_view name, std::string_view value) {
  constexpr std::array<std::string_view, 10> kFillers{"axis", "is",       "points", "positive",  "increases",
                                                      "runs", "pointing", "goes",   "direction", "to"};
  constexpr std::array<std::string_view, 5> kUp{"up", "upward", "upwards", "oben", "haut"};
  constexpr std::array<std::string_view, 5> kDown{"down", "downward", "downwards", "unten", "bas"};
  constexpr std::array<std::string_view, 3> kYes{"yes", "true", "on"}, kNo{"no", "false", "off"};
  const std::string letters = letters_of(name.substr(name.find_last_of("./:") + 1));
  if (letters.empty() || std::string_view("xyz").find(letters.front()) == std::string_view::npos) return std::nullopt;
  const char axis = letters.front();
  std::string_view rest = std::string_view(letters).substr(1);
  for (bool cut = true; cut;) {
    cut = false;
    for (const std::string_view filler : kFillers) {
      if (rest.starts_with(filler)) rest.remove_prefix(filler.size()), cut = true;
    }
  }
  const bool sideways = axis == 'x';
  const bool usual = sideways ? rest == "right" || rest == "theright" : is_among(rest, kUp);
  const bool other = sideways ? rest == "left" || rest == "theleft" : is_among(rest, kDown);
  if (!usual && !other) return std::nullopt;
  const std::string word = letters_of(value);
  // "x_right = 1" may be a place.
  const bool affirmed = is_among(word, kYes) || (word == "1" && !sideways);
  const bool denied = is_among(word, kNo) || (word == "0" && !sideways);
  if (!affirmed && !denied) return std::nullopt;
  return AxisClaim{axis, affirmed == usual};
}

AxisOrder read_axis_order(const std::vector<std::string>& texts, const std::vector<double>& numbers) {
  if (texts.empty()) {
    const bool turned = numbers.size() == 2 && numbers[0] == numbers[1] + 1.0 && numbers[0] <= 2.0;
    return turned ? AxisOrder::ColumnsFirst : AxisOrder::RowsFirst;
  }
  std::vector<std::string> words;
  for (const std::string& text : texts) {
    for (std::string& word : axis_words(text)) words.push_back(std::move(word));
  }
  return order_of(words);
}

}  // namespace dwell
