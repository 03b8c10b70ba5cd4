#include "core/map/unit_mention.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

/// Words of the trade for units that no number here is ever in.
constexpr std::array<std::string_view, 12> kForeignWords{
    "imperial", "thou", "mil", "mils", "foot", "feet", "ft", "ipm", "microinches", "microseconds", "ips", "us"};

/// Units of time other than the second. "min" and "h" alone are too short to be taken for one everywhere.
constexpr std::array<std::string_view, 9> kOtherTimes{
    "ms", "msec", "millisecond", "milliseconds", "min", "minutes", "minute", "hours", "h"};

/// After these a short sign ("um", "in") is a unit.
constexpr std::array<std::string_view, 33> kQuantities{
    "x",        "y",      "z",         "xy",         "xyz",        "f",           "p",      "feed",     "feeds",
    "feedrate", "speed",  "speeds",    "velocity",   "coordinate", "coordinates", "coords", "position", "positions",
    "point",    "points", "dimension", "dimensions", "distance",   "distances",   "dwell",  "dwells",   "time",
    "times",    "value",  "values",    "scale",      "size",       "pitch"};

/// What is measured in nm or nm/s in any optical shop, and is none of a path's numbers.
constexpr std::array<std::string_view, 9> kHeightWords{"height", "heights", "surface",   "residual", "rms",
                                                       "pv",     "removal", "roughness", "tif"};

/// A word of a comment and what stands around it.
struct CommentWord {
  std::string text;          // in lower case
  std::string_view shown;    // as in the comment
  bool enclosed = false;     // in brackets, alone or after "in"
  bool after_sign = false;   // ':' or '=' directly before it
  bool ends_clause = false;  // nothing, or a comma and its like, behind it
};

bool parts_words(char c) { return std::string_view(" \t\r,;:=()[]{}<>\"'|!?").find(c) != std::string_view::npos; }

std::vector<CommentWord> words_of_comment(std::string_view comment) {
  std::vector<CommentWord> words;
  bool sign = false, open = false;
  for (std::size_t i = 0; i < comment.size();) {
    const char c = comment[i];
    if (parts_words(c)) {
      if (c == ':' || c == '=') sign = true;
      if (c == '(' || c == '[') open = true;
      if (c != ' ' && c != '\t' && !words.empty()) words.back().ends_clause = true;
      ++i;
      continue;
    }
    const std::size_t start = i;
    while (i < comment.size() && !parts_words(comment[i])) ++i;
    std::string_view shown = comment.substr(start, i - start);
    const bool stop = shown.size() > 1 && shown.ends_with('.');
    if (stop) shown.remove_suffix(1);
    const bool closed = i < comment.size() && (comment[i] == ')' || comment[i] == ']');
    words.push_back({lower_case(shown), shown, open && closed, sign, stop});
    if (words.back().text != "in") sign = open = false;
  }
  if (!words.empty()) words.back().ends_clause = true;
  return words;
}

bool begins_with_digit(std::string_view word) {
  const std::size_t at = word.find_first_not_of("+-.~");
  return at != std::string_view::npos && word[at] >= '0' && word[at] <= '9';
}

/// Whether a unit says the same as ours: mm, mm/min, s.
bool is_own_unit(std::string_view unit, bool milliseconds) {
  if (const auto length = known_length_unit(unit)) return *length == units::kNmPerMm;
  if (const auto rate = known_rate_unit(unit)) return *rate == units::kNmPerMm / units::kSecondsPerMinute;
  return milliseconds && (unit == "ms" || unit == "msec" || unit.starts_with("millisecond"));
}

/// "mm/rev", "inch/tooth": a length per something that is no time, or a time.
bool is_quotient_of_length(std::string_view word) {
  const std::size_t slash = word.find('/');
  if (slash == std::string_view::npos || slash == 0 || slash + 1 == word.size()) return false;
  return known_rate_unit(word) ||
         (known_length_unit(word.substr(0, slash)) && word.find('/', slash + 1) == std::string_view::npos);
}

bool is_any_unit(std::string_view word) {
  return known_length_unit(word) || is_quotient_of_length(word) || is_among(word, kForeignWords) ||
         is_among(word, kOtherTimes);
}

/// Whether a word is too long to be anything but a unit: "inches", "microns", "mm/s". "minutes" and "hours" are prose.
bool is_unmistakable(std::string_view word) {
  constexpr std::size_t kLongestSign = 3;
  if (is_quotient_of_length(word) || word == "imperial" || word == "ipm") return true;
  return word.size() > kLongestSign && (known_length_unit(word) || is_among(word, kForeignWords)) && word != "foot" &&
         word != "feet" && word != "meter" && word != "thou";
}

/// The unit at the end of a name: "um" of "x_um" and "x/um", "mm/s" of "feed_mm_per_s" and "feed_mm_s".
std::string suffix_of(std::string_view word) {
  const std::size_t at = word.find_last_of("_/");
  if (at == std::string_view::npos || at == 0) return {};
  const std::string_view last = word.substr(at + 1);
  std::string_view before = word.substr(0, at);
  if (before.ends_with("_per")) before.remove_suffix(4);
  const std::string rate = std::string(before.substr(before.find_last_of('_') + 1)) + "/" + std::string(last);
  return word[at] == '_' && known_rate_unit(rate) ? rate : std::string(last);
}

class OtherUnit {
 public:
  OtherUnit(std::string_view comment, bool milliseconds)
      : milliseconds_(milliseconds), words_(words_of_comment(comment)) {}

  std::optional<std::string> find() const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if (speaks_of_heights(i)) continue;
      if (auto found = phrase_at(i)) return found;
      if (is_other(i)) return std::string(words_[i].shown);
    }
    return std::nullopt;
  }

 private:
  /// "mm per second", "mm s-1", of three or two words.
  std::optional<std::string> phrase_at(std::size_t i) const {
    if (!known_length_unit(words_[i].text) || after_number(i)) return std::nullopt;
    for (const std::size_t count : {std::size_t{3}, std::size_t{2}}) {
      if (i + count > words_.size()) continue;
      std::string phrase = words_[i].text;
      for (std::size_t k = 1; k < count; ++k) phrase += " " + words_[i + k].text;
      const bool per = count == 3 && words_[i + 1].text == "per";
      if (!per && !known_rate_unit(phrase)) continue;
      return is_own_unit(phrase, milliseconds_) ? std::nullopt : std::optional(phrase);
    }
    return std::nullopt;
  }

  bool is_other(std::size_t i) const {
    const CommentWord& word = words_[i];
    if (const std::string suffix = suffix_of(word.text); !suffix.empty() && !is_any_unit(word.text)) {
      if (is_any_unit(suffix) && !is_own_unit(suffix, milliseconds_)) return true;
    }
    if (!is_any_unit(word.text) || is_own_unit(word.text, milliseconds_)) return false;
    if (is_part_of_own_rate(i)) return false;
    if (after_number(i)) return says_units() && !is_among(word.text, kOtherTimes);
    return is_unmistakable(word.text) || stands_as_unit(i);
  }

  /// The "min" of "mm / min" and "mm per min".
  bool is_part_of_own_rate(std::size_t i) const {
    return i >= 2 && (words_[i - 1].text == "/" || words_[i - 1].text == "per") &&
           known_length_unit(words_[i - 2].text);
  }

  /// Whether a short sign stands where a unit would: "in um", "[um]", "unit um", "x: um", "x, y um", "um" alone.
  bool stands_as_unit(std::size_t i) const {
    const CommentWord& word = words_[i];
    const bool alone = words_.size() == 1;
    if (i + 1 < words_.size() && !word.ends_clause && begins_with_digit(words_[i + 1].text)) return false;  // "min 10"
    if (alone || word.enclosed) return true;
    if (word.after_sign) return word.text != "in" || word.ends_clause;
    if (i == 0) return false;
    const std::string_view before = words_[i - 1].text;
    if (before == "unit" || before == "units") return word.text != "in" || word.ends_clause;
    if (word.text == "in") return word.ends_clause && is_among(before, kQuantities);
    return before == "in" || before == "is" || before == "are" || is_among(before, kQuantities);
  }

  bool after_number(std::size_t i) const {
    return i > 0 && begins_with_digit(words_[i - 1].text) && !words_[i].after_sign;
  }

  /// "1 unit = 10 um", "units: 0.001 inch".
  bool says_units() const {
    return std::any_of(words_.begin(), words_.end(),
                       [](const CommentWord& w) { return w.text == "unit" || w.text == "units"; });
  }

  /// Whether the unit at i is that of a height or a removal rate: small, behind their word, and no quantity of a path
  /// is named.
  bool speaks_of_heights(std::size_t i) const {
    const auto factor = known_value_unit(words_[i].text);
    if (!factor || *factor > units::kNmPerUm) return false;
    const auto word_of = [](const auto& list) { return [&](const CommentWord& w) { return is_among(w.text, list); }; };
    const auto here = words_.begin() + static_cast<std::ptrdiff_t>(i);
    return std::any_of(words_.begin(), here, word_of(kHeightWords)) &&
           std::none_of(words_.begin(), words_.end(), word_of(kQuantities));
  }

  bool milliseconds_;
  std::vector<CommentWord> words_;
};

}  // namespace

std::optional<std::string> find_other_unit(std::string_view comment, bool milliseconds) {
  return OtherUnit(comment, milliseconds).find();
}

}  // namespace dwell
