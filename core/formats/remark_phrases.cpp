#include "core/formats/remark_phrases.h"

#include <string>

#include "core/base/number_text.h"
#include "core/formats/map_terms.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

/// Quantities of a measurement that are no heights, and figures of a whole map: their unit is not that of the values.
constexpr std::array<std::string_view, 65> kOtherQuantities{"aperture",
                                                            "diameter",
                                                            "radius",
                                                            "tool",
                                                            "wheel",
                                                            "pad",
                                                            "stop",
                                                            "focal",
                                                            "thickness",
                                                            "distance",
                                                            "wavelength",
                                                            "wavelengths",
                                                            "laser",
                                                            "light",
                                                            "spot",
                                                            "beam",
                                                            "filter",
                                                            "lens",
                                                            "stroke",
                                                            "speed",
                                                            "objective",
                                                            "cutoff",
                                                            "band",
                                                            "period",
                                                            "lines",
                                                            "gap",
                                                            "slurry",
                                                            "rms",
                                                            "pv",
                                                            "p-v",
                                                            "ptv",
                                                            "ra",
                                                            "rq",
                                                            "rz",
                                                            "sa",
                                                            "sq",
                                                            "sz",
                                                            "pvr",
                                                            "pvq",
                                                            "std",
                                                            "sigma",
                                                            "peak",
                                                            "peak-to-valley",
                                                            "valley",
                                                            "noise",
                                                            "uncertainty",
                                                            "accuracy",
                                                            "precision",
                                                            "repeatability",
                                                            "roughness",
                                                            "temperature",
                                                            "exposure",
                                                            "time",
                                                            "wavelengt",
                                                            "wellenlaenge",
                                                            "durchmesser",
                                                            "blende",
                                                            "rauheit",
                                                            "longueur",
                                                            "diametre",
                                                            "ouverture",
                                                            "stitching",
                                                            "overlap",
                                                            "step",
                                                            "steps"};
constexpr std::array<std::string_view, 18> kNumberWords{
    "a",        "few",  "several", "some",    "sub",      "one", "two",  "three",  "half",
    "hundreds", "tens", "per",     "hundred", "thousand", "ten", "many", "couple", "below"};

}  // namespace

bool is_denied(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 6> kNo{"not", "no", "nicht", "non", "never", "without"};
  return at > 0 && is_among(words[at - 1].folded, kNo);
}

bool holds_value_word(const Remark& words, std::size_t from, std::size_t to) {
  return std::any_of(words.begin() + static_cast<std::ptrdiff_t>(from), words.begin() + static_cast<std::ptrdiff_t>(to),
                     [](const RemarkWord& word) { return is_value_word(word.folded) || word.folded == "wavefront"; });
}

std::size_t clause_of(const Remark& words, std::size_t at) {
  while (at > 0 && !words[at].clause) --at;
  return at;
}

bool is_of_another_quantity(const Remark& words, std::size_t at) {
  const std::size_t begin = clause_of(words, at);
  if (holds_value_word(words, begin, at)) return false;
  return std::any_of(words.begin() + static_cast<std::ptrdiff_t>(begin),
                     words.begin() + static_cast<std::ptrdiff_t>(at),
                     [](const RemarkWord& word) { return is_among(word.folded, kOtherQuantities); });
}

bool names_a_number(const Remark& words, std::size_t at) {
  const bool valued =
      at + 1 < words.size() && words[at + 1].number && (words[at + 1].before == ':' || words[at + 1].before == '=');
  return valued || (at + 1 < words.size() && words[at].closed && words[at + 1].number);
}

bool follows_a_number(const Remark& words, std::size_t at) {
  if (at == 0 || words[at].before != ' ') return false;
  return words[at - 1].number || is_among(words[at - 1].folded, kNumberWords);
}

bool is_announced(const Remark& words, std::size_t at) {
  if (words[at].bracketed() || std::string_view(",:=").find(words[at].before) != std::string_view::npos) return true;
  return at > 0 && (words[at - 1].folded == "in" || words[at - 1].folded == "en" ||
                    words[at - 1].folded == "\xd0\xb2" || is_unit_name(words[at - 1].folded));
}

std::optional<double> unit_of_word(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 9> kCommon{"m",     "pm",  "meter",    "metre",       "metro",
                                                    "metri", "mil", "\xd0\xbc", "\xe7\xb1\xb3"};
  const RemarkWord& word = words[at];
  if (word.folded == "in") return std::nullopt;
  if (is_among(word.folded, kCommon) && (!is_announced(words, at) || word.text == "M" || (word.dot && at == 0)))
    return std::nullopt;
  if (const auto unit = known_value_unit(word.text)) return unit;
  // "z/um" and "height_nm" hold their unit.
  const std::size_t sign = word.folded.find_last_of("/_");
  if (sign == std::string::npos || !is_value_word(word.folded.substr(0, sign))) return std::nullopt;
  return known_value_unit(word.folded.substr(sign + 1));
}

std::optional<double> number_of(const RemarkWord& word) {
  if (const auto number = finite_number(word.text)) return number;
  std::string pointed = word.text;
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  return finite_number(pointed);
}

}  // namespace dwell
