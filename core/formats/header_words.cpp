#include "core/formats/header_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/formats/map_terms.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr std::array<std::string_view, 33> kWordsThatSayNothing{
    "in",   "is",  "are",  "the",  "of",  "all", "a",   "given", "map",    "and",  "per",
    "for",  "as",  "both", "this", "der", "die", "das", "des",   "den",    "alle", "aller",
    "sind", "ist", "und",  "von",  "en",  "est", "les", "la",    "toutes", "tous", "sont"};

constexpr std::array<std::string_view, 4> kPixelWords{"px", "pix", "pixel", "pixels"};

/// Whether a word in a name is a unit there. "in" is not: it says where the unit stands.
bool is_unit_in_name(std::string_view word) { return lower_case(word) != "in" && known_value_unit(word); }

/// Cuts "/pixel", " per px" and their like off the end.
bool cut_per_pixel(std::string_view& text) {
  for (const std::string_view per : {"/", "per"}) {
    for (const std::string_view pixel : kPixelWords) {
      std::string_view rest = trim(text);
      if (!lower_case(rest).ends_with(pixel)) continue;
      rest = trim(rest.substr(0, rest.size() - pixel.size()));
      if (!lower_case(rest).ends_with(per)) continue;
      text = trim(rest.substr(0, rest.size() - per.size()));
      return true;
    }
  }
  return false;
}

/// The words of a name: what stands in brackets is one word. '_', '-' and '.' part words as blanks do.
std::vector<std::string> parts_of_name(std::string_view text) {
  std::vector<std::string> parts;
  std::string word;
  const auto end_word = [&] {
    if (!word.empty()) parts.push_back(word);
    word.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(' || c == '[') {
      end_word();
      const std::size_t close = text.find(c == '(' ? ')' : ']', i);
      const std::size_t stop = std::min(close, text.size());
      parts.emplace_back(trim(text.substr(i + 1, stop - i - 1)));
      i = stop;
    } else if (c == ' ' || c == '\t' || c == '_' || c == '-' || c == '.' || c == ',' || c == '"' || c == '\'') {
      end_word();
    } else {
      word += c;
    }
  }
  end_word();
  return parts;
}

bool is_axis(std::string_view word) { return word == "x" || word == "y" || word == "z"; }

void take_unit(HeaderKey& key, const std::string& word) {
  key.unit = word;
  key.length = known_length_unit(word);
}

/// The unit of a name is its last word ("pitch_um"), or stands in brackets wherever it is.
void take_words(HeaderKey& key, const std::vector<std::string>& parts, std::string_view text) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string word = fold_letters(parts[i]);
    const bool bracketed =
        text.find('(' + parts[i]) != std::string_view::npos || text.find('[' + parts[i]) != std::string_view::npos;
    const bool may_be_unit = bracketed || (i + 1 == parts.size() && (i > 0 || key.per_pixel));
    if (key.unit.empty() && may_be_unit && is_unit_in_name(parts[i])) {
      take_unit(key, parts[i]);
    } else if (is_axis(word) || word == "xy" || word == "xyz") {
      key.every_axis = key.every_axis || word == "xyz" || (word == "z" && key.axis != 0 && key.axis != 'z');
      if (key.axis == 0) key.axis = word.front();
      if (key.every_axis) key.axis = 'z';
    } else if (bracketed) {
      key.remark = word;
    } else if (!is_among(word, kWordsThatSayNothing)) {
      key.words.push_back(word);
    }
  }
}

/// Reads the unit after a number: letters and what is no ASCII ("mm", "µm"), up to a separator.
std::string_view unit_word(std::string_view& rest) {
  std::size_t size = 0;
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
  };
  while (size < rest.size() && is_letter(rest[size])) ++size;
  const std::string_view word = rest.substr(0, size);
  if (word == "x" || word == "X") return {};
  rest.remove_prefix(size);
  return word;
}

/// Skips at most one of ',', ';', 'x', '*', '/' and the blanks around it.
void skip_separator(std::string_view& rest) {
  rest = trim(rest);
  if (!rest.empty() && std::string_view(",;xX*/").find(rest.front()) != std::string_view::npos) {
    rest = trim(rest.substr(1));
  }
}

/// Half a unit of the last digit that is written, as a part of the number.
double rounding_of(std::string_view written, double number) {
  const std::size_t exponent = written.find_first_of("eE");
  const std::string_view digits = written.substr(0, exponent);
  const std::size_t point = digits.find('.');
  double unit = point == std::string_view::npos ? 1.0 : std::pow(10.0, -static_cast<double>(digits.size() - point - 1));
  if (exponent != std::string_view::npos) {
    unit *= std::pow(10.0, parse_number(written.substr(exponent + 1)).value_or(0.0));
  }
  return number == 0.0 ? 0.0 : 0.5 * unit / std::abs(number);
}

/// Takes one number and its unit off the text; false if there is none or its unit differs.
bool take_length(std::string_view& rest, HeaderLengths& lengths, bool& has_unit) {
  if (rest.size() > 1 && rest[0] == '+' && rest[1] != '-') rest.remove_prefix(1);
  double number = 0.0;
  const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return false;
  const auto size = static_cast<std::size_t>(stop - rest.data());
  lengths.numbers.push_back(number);
  lengths.rounding = std::max(lengths.rounding, rounding_of(rest.substr(0, size), number));
  rest = trim(rest.substr(size));
  const std::string unit = lower_case(unit_word(rest));
  if (unit.empty()) return true;
  if (is_among(unit, kPixelWords)) {
    lengths.pixels = true;
    return !has_unit;
  }
  const auto length = known_length_unit(unit);
  if (!length || lengths.pixels || (has_unit && length != lengths.length)) return false;
  has_unit = true;
  lengths.length = length;
  return true;
}

}  // namespace

bool HeaderKey::has(std::string_view word) const { return std::find(words.begin(), words.end(), word) != words.end(); }

HeaderKey parse_header_key(std::string_view text) {
  HeaderKey key;
  key.shown = trim(text);
  std::string_view rest = trim(text);
  key.per_pixel = cut_per_pixel(rest);
  take_words(key, parts_of_name(rest), rest);
  constexpr std::array<std::string_view, 3> kDegrees{"deg", "degree", "degrees"};  // say no more: rotation_deg
  if (key.words.size() > 1 && is_among(key.words.back(), kDegrees)) key.words.pop_back();
  for (const std::string& word : key.words) key.stem += word;
  return key;
}

std::vector<double> HeaderLengths::mm(double otherwise) const {
  std::vector<double> result;
  const double unit = length.value_or(otherwise);
  // What is in mm stays exactly as it is written.
  for (const double number : numbers) {
    result.push_back(unit == units::kNmPerMm ? number : number * unit / units::kNmPerMm);
  }
  return result;
}

std::optional<HeaderLengths> parse_header_lengths(std::string_view text, std::size_t most) {
  const std::string plain = with_letter_times(trim(text));
  std::string_view rest = plain;
  cut_per_pixel(rest);
  if (rest.size() >= 2 && (rest.front() == '[' || rest.front() == '(')) {
    const std::size_t close = rest.find(rest.front() == '[' ? ']' : ')');
    if (close == std::string_view::npos) return std::nullopt;
    const std::string inner = std::string(rest.substr(1, close - 1)) + " " + std::string(rest.substr(close + 1));
    return parse_header_lengths(inner, most);
  }
  HeaderLengths lengths;
  bool has_unit = false;
  while (!rest.empty()) {
    if (!take_length(rest, lengths, has_unit)) return std::nullopt;
    if (lengths.numbers.size() > most) return std::nullopt;
    const std::string_view before = trim(rest);
    skip_separator(rest);
    if (rest.empty() && !before.empty()) return std::nullopt;  // "1,"
  }
  return lengths.numbers.empty() ? std::nullopt : std::optional(lengths);
}

bool may_have_decimal_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return comma != std::string_view::npos && comma > 0 && comma + 1 < text.size() && digit(text[comma - 1]) &&
         digit(text[comma + 1]) && text.find('.') == std::string_view::npos &&
         text.find(',', comma + 1) == std::string_view::npos;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = trim(text); !text.empty(); text = trim(text)) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

bool are_value_words(const std::vector<std::string>& words) {
  return !words.empty() &&
         std::all_of(words.begin(), words.end(), [](const std::string& w) { return is_value_word(w); });
}

}  // namespace dwell
