#include "core/formats/remark_values.h"

#include <cmath>
#include <string>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr std::array<std::string_view, 24> kCounts{
    "count",     "counts",    "lsb", "digit",  "digits",  "level", "levels", "adu",    "bit",    "bits", "grey", "gray",
    "greylevel", "graylevel", "dn",  "fringe", "fringes", "wave",  "waves",  "lambda", "radian", "rad",  "volt", "v"};
constexpr std::array<std::string_view, 14> kWaves{"waves",  "wave",   "wv",       "fringe",  "fringes",
                                                  "lambda", "rad",    "radian",   "radians", "mrad",
                                                  "urad",   "counts", "\xce\xbb", "count"};

/// "1e-3", "10^-9", "10**-9", "10-9".
bool is_power_of_ten(std::string_view text) {
  const auto number = finite_number(text);
  if (number && text.find_first_of("eE") != std::string_view::npos) {
    return *number > 0.0 && std::log10(*number) == std::round(std::log10(*number));
  }
  if (!text.starts_with("10")) return false;
  text.remove_prefix(2);
  for (const std::string_view sign : {"^", "**"}) {
    if (text.starts_with(sign)) return true;
  }
  return text.size() > 1 && (text.front() == '-' || text.front() == '+') && finite_number(text.substr(1));
}

}  // namespace

bool speaks_of_a_unit(const Remark& words, std::size_t at) {
  return unit_of_word(words, at) && !follows_a_number(words, at) && !names_a_number(words, at) &&
         !is_of_another_quantity(words, at);
}

bool speaks_of_waves(const Remark& words, std::size_t at) {
  if (!is_among(words[at].folded, kWaves) || follows_a_number(words, at) || is_of_another_quantity(words, at))
    return false;
  if (names_a_number(words, at)) return false;
  constexpr std::array<std::string_view, 5> kAlsoProse{"wave", "fringe", "count", "counts", "fringes"};
  if (is_among(words[at].folded, kAlsoProse)) return is_announced(words, at) && words[at].before != ',';
  return is_announced(words, at) || holds_value_word(words, clause_of(words, at), at);
}

bool is_per_count(const Remark& words, std::size_t at) {
  const std::string& word = words[at].folded;
  const std::size_t slash = word.find('/');
  if (slash != std::string::npos) {
    const std::string above = word.substr(0, slash), below = word.substr(slash + 1);
    return (known_length_unit(above) && is_among(below, kCounts)) ||
           (is_among(above, kCounts) && known_length_unit(below));
  }
  if (word != "per" || at == 0 || at + 1 == words.size()) return false;
  const std::string &above = words[at - 1].folded, &below = words[at + 1].folded;
  return (known_length_unit(above) && is_among(below, kCounts)) ||
         (is_among(above, kCounts) && known_length_unit(below));
}

bool is_a_factor(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 22> kVerbs{
      "gain",     "scale",         "factor",    "multiplier", "conversion",  "sensitivity", "scaled",  "multiplied",
      "multiply", "divided",       "divide",    "amplified",  "faktor",      "skaliert",    "facteur", "multiplie",
      "divise",   "multipliziert", "dividiert", "geteilt",    "scalefactor", "lsb"};
  constexpr std::array<std::string_view, 8> kBetween{"by", "of", "is", "mit", "durch", "par", "with", "von"};
  if (is_among(words[at].folded, kVerbs)) {
    std::size_t next = at + 1;
    while (next < words.size() && is_among(words[next].folded, kBetween)) ++next;
    if (next < words.size() && words[next].number && number_of(words[next]).value_or(0.0) != 1.0) return true;
  }
  const bool values = holds_value_word(words, clause_of(words, at), at);
  const bool times = words[at].folded == "x" || words[at].folded == "*" || words[at].folded == "times";
  if (times && values && at > 0 && !words[at - 1].number && at + 1 < words.size() && words[at + 1].number) return true;
  const bool joined = words[at].text.size() > 1 && (words[at].text.front() == 'x' || words[at].text.front() == '*') &&
                      finite_number(words[at].text.substr(1)).has_value();
  if (joined && values) return true;
  if (at + 1 >= words.size() || !words[at].number || words[at + 1].before != ' ' ||
      !known_value_unit(words[at + 1].text))
    return false;
  constexpr std::array<std::string_view, 4> kSteps{"units", "unit", "steps", "multiples"};
  const bool of = at > 1 && words[at - 1].folded == "of" && is_among(words[at - 2].folded, kSteps);
  const bool in = at > 0 && (of || words[at - 1].folded == "in" || words[at - 1].text == "/");
  if (is_power_of_ten(words[at].text)) return values || in || words[at].bracketed();
  const bool small = known_value_unit(words[at + 1].text).value_or(0.0) < units::kNmPerMm;
  return values && number_of(words[at]).value_or(0.0) != 1.0 &&
         ((words[at].bracketed() && words[at + 1].closed) || (in && small));
}

}  // namespace dwell
