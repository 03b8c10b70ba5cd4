#include "core/formats/said_factor.h"

#include <algorithm>
#include <array>

#include "core/base/number_text.h"
#include "core/base/word_list.h"
#include "core/formats/map_terms.h"

namespace dwell {
namespace {

bool is_prefix_of_units(std::string_view word) {
  constexpr std::array<std::string_view, 20> kPrefixes{"micro", "nano",  "milli", "pico",     "kilo", "centi",   "deci",
                                                       "mikro", "femto", "mega",  "u",        "n",    "m",       "p",
                                                       "k",     "c",     "d",     "\xc2\xb5", "f",    "\xce\xbc"};
  return is_among(word, kPrefixes);
}

bool is_usual_sign(std::string_view word) {
  constexpr std::array<std::string_view, 10> kUsual{"+",    "+1", "1",  "positive",  "positiv",
                                                    "plus", "up", "no", "unchanged", "normal"};
  return is_among(word, kUsual);
}

bool holds(const std::string& name, std::string_view word) { return name.find(word) != std::string::npos; }

bool is_sign(const std::string& name) {
  constexpr std::array<std::string_view, 7> kSignNames{"sign", "vorzeichen", "polarity", "direction",
                                                       "zdir", "positive",   "zup"};
  return std::any_of(kSignNames.begin(), kSignNames.end(), [&](std::string_view word) { return holds(name, word); });
}

bool leaves(const std::string& name, const std::string& text) {
  constexpr std::array<std::string_view, 7> kNothing{"", "none", "no", "false", "identity", "null", "keine"};
  const std::string word = fold_letters(trim(text));
  if (is_among(word, kNothing)) return true;
  if (holds(name, "prefix")) return !is_prefix_of_units(word);
  if (is_sign(name)) return is_usual_sign(word);
  return finite_number(word) == neutral_number(name);
}

}  // namespace

bool may_be_a_word(std::string_view name) {
  const std::string folded = fold_letters(name);
  return is_sign(folded) || holds(folded, "prefix") || holds(folded, "norm");
}

double neutral_number(std::string_view name) {
  constexpr std::array<std::string_view, 9> kAdded{"offset", "intercept", "exponent", "waves", "power",
                                                   "normal", "normed",    "flip",     "negat"};
  const std::string folded = fold_letters(name);
  return std::any_of(kAdded.begin(), kAdded.end(), [&](std::string_view word) { return holds(folded, word); }) ? 0.0
                                                                                                               : 1.0;
}

bool leaves_heights(std::string_view name, const std::vector<double>& numbers, const std::vector<std::string>& texts) {
  const std::string folded = fold_letters(name);
  const double neutral = neutral_number(name);
  return std::all_of(numbers.begin(), numbers.end(),
                     [&](double number) { return number == neutral || (holds(folded, "prefix") && number == 0.0); }) &&
         std::all_of(texts.begin(), texts.end(), [&](const std::string& text) { return leaves(folded, text); });
}

}  // namespace dwell
