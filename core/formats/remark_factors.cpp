#include "core/formats/remark_factors.h"

#include <cmath>
#include <string>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/map_terms.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr std::array<std::string_view, 24> kCounts{
    "count",     "counts",    "lsb", "digit",  "digits",  "level", "levels", "adu",    "bit",    "bits", "grey", "gray",
    "greylevel", "graylevel", "dn",  "fringe", "fringes", "wave",  "waves",  "lambda", "radian", "rad",  "volt", "v"};
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

bool is_count(std::string_view word) { return is_among(word, kCounts); }

/// A word that stands for the numbers of the file, or a unit: what a factor may belong to.
bool may_have_a_factor(std::string_view word) {
  const bool wave =
      word.starts_with("lambda") || word.starts_with("wave") || word.starts_with("fringe");  // "lambda/20"
  return is_value_word(word) || (is_count(word) && !wave) || word == "z" || known_length_unit(word);
}

bool is_other_number(std::string_view text) {
  const auto number = finite_number(text);
  return number && *number != 1.0;
}

/// "0.5*value", "nm*10", "*1000", "z/1000".
bool is_product(std::string_view word) {
  const std::size_t times = word.find('*');
  if (times != std::string_view::npos && word.substr(times).substr(0, 2) != "**") {
    const std::string_view left = word.substr(0, times), right = word.substr(times + 1);
    return (is_other_number(right) && !finite_number(left)) || (is_other_number(left) && !finite_number(right));
  }
  const std::size_t over = word.find('/');
  return over != std::string_view::npos && may_have_a_factor(word.substr(0, over)) &&
         is_other_number(word.substr(over + 1));
}

/// "0.5 * value", "value / 1000", "nm x 10".
bool is_between_factors(const Remark& words, std::size_t at) {
  const std::string& sign = words[at].folded;
  if ((sign != "*" && sign != "x" && sign != "/") || at == 0 || at + 1 >= words.size()) return false;
  const RemarkWord &left = words[at - 1], &right = words[at + 1];
  const bool of_number = at > 1 && words[at - 2].number;  // "100 mm x 2"
  const bool divided = is_other_number(right.text) && may_have_a_factor(left.folded) && !of_number;
  if (sign == "/") return divided;
  const bool multiplied = is_other_number(left.text) && may_have_a_factor(right.folded);
  const bool number = sign == "*" && is_other_number(left.text) != is_other_number(right.text);
  return divided || multiplied || number;
}

/// "1 count = 0.1 nm": what one of the file's numbers is.
bool is_worth(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 12> kOtherThings{"pixel", "pixels", "px",  "pix", "s",   "min",
                                                          "h",     "turn",   "deg", "day", "bar", "point"};
  if (at + 3 >= words.size() || !words[at].number || !finite_number(words[at].text)) return false;
  const std::string& what = words[at + 1].folded;
  if (known_value_unit(what) || is_among(what, kOtherThings) || words[at + 1].number) return false;
  const bool dash = words[at + 2].folded == "-" && at + 4 < words.size();  // "->"
  const std::size_t number = dash ? at + 3 : at + 2;
  const bool equal = words[number].before == '=' || words[number].before == '>';
  return equal && words[number].number && known_length_unit(words[number + 1].text);
}

/// "counts to nm".
bool is_converted(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 3> kTo{"to", "nach", "en"};
  return is_among(words[at].folded, kTo) && at > 0 && at + 1 < words.size() &&
         (is_count(words[at - 1].folded) || is_value_word(words[at - 1].folded)) &&
         known_length_unit(words[at + 1].text) && (at + 2 == words.size() || words[at + 2].number);
}

/// "normalised", "arbitrary units", "values in %".
bool is_relative(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 8> kNormed{"normalised", "normalized", "normiert",    "normalisiert",
                                                    "normalise",  "normalisee", "normalizado", "normalizzato"};
  constexpr std::array<std::string_view, 4> kArbitrary{"a.u", "arb", "arbitrary", "willkuerlich"};
  const std::string& word = words[at].folded;
  if (is_among(word, kNormed)) return !is_denied(words, at);
  if (word == "a.u") return true;
  if (is_among(word, kArbitrary)) return at + 1 < words.size() && words[at + 1].folded.starts_with("unit");
  const bool percent = word == "%" || word == "percent" || word == "prozent";
  return percent && !follows_a_number(words, at) && is_announced(words, at) &&
         holds_value_word(words, clause_of(words, at), at);
}

/// Whether nothing but a unit stands behind the word.
bool ends_with_a_unit(const Remark& words, std::size_t at) {
  return at + 2 == words.size() && known_value_unit(words[at + 1].text) && words[at + 1].before == ' ';
}

/// "x1000", "1e-6 m", "0.1 nm", "micro": a remark that is nothing but a factor, or a unit with one.
bool stands_alone(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 6> kPrefixes{"micro", "nano", "milli", "pico", "mikro", "femto"};
  constexpr std::array<std::string_view, 6> kSteps{"10", "100", "1000", "0.1", "0.01", "0.001"};
  const std::string& word = words[at].text;
  const bool ends = at + 1 == words.size(), begins = words[at].clause;
  if (begins && ends && is_among(words[at].folded, kPrefixes)) return true;
  if (begins && ends && (word.front() == 'x' || word.front() == 'X') &&
      is_other_number(std::string_view(word).substr(1)))
    return true;
  const bool sign = word == "x" || word == "X" || word == "*";
  if (begins && at + 2 == words.size() && sign &&
      (is_power_of_ten(words[at + 1].text) || is_other_number(words[at + 1].text)))
    return true;
  // "x 1e-6 m", "e-6 m"
  const bool of_unit = ends_with_a_unit(words, at);
  if (begins && of_unit && at + 2 == words.size() && is_power_of_ten("1" + word)) return true;
  if (begins && at + 3 == words.size() && sign && ends_with_a_unit(words, at + 1) &&
      (is_power_of_ten(words[at + 1].text) || is_power_of_ten("1" + words[at + 1].text)))
    return true;
  const bool pair = begins && of_unit;
  if (!pair) return false;
  const bool small = known_value_unit(words[at + 1].text).value_or(0.0) < units::kNmPerMm;
  return is_power_of_ten(word) || (at == 0 && small && is_among(word, kSteps));
}

/// "gain of 2.5", "values x 1e-3", "height [10 nm]", "surface in 1e-9 m".
bool is_named_factor(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 25> kVerbs{
      "gain",       "scale",     "factor",   "multiplier",    "conversion", "sensitivity", "scaled",
      "multiplied", "multiply",  "divided",  "divide",        "amplified",  "faktor",      "skaliert",
      "facteur",    "multiplie", "divise",   "multipliziert", "dividiert",  "geteilt",     "scalefactor",
      "lsb",        "divisor",   "exponent", "scaling"};
  constexpr std::array<std::string_view, 8> kBetween{"by", "of", "is", "mit", "durch", "par", "with", "von"};
  if (is_among(words[at].folded, kVerbs)) {
    std::size_t next = at + 1;
    while (next < words.size() && is_among(words[next].folded, kBetween)) ++next;
    if (next < words.size() && words[next].number && number_of(words[next]).value_or(0.0) != 1.0) return true;
    constexpr std::array<std::string_view, 8> kNumbers{"two",     "three",    "four", "ten",
                                                       "hundred", "thousand", "half", "million"};
    if (next < words.size() && is_among(words[next].folded, kNumbers)) return true;
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

}  // namespace

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
  return is_product(words[at].folded) || is_between_factors(words, at) || is_worth(words, at) ||
         is_converted(words, at) || is_relative(words, at) || stands_alone(words, at) || is_named_factor(words, at);
}

}  // namespace dwell
