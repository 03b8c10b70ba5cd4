#include "core/formats/remark_places.h"

#include <string>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/map_terms.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

constexpr std::array<std::string_view, 7> kPixelNames{"pixel", "pixels", "px", "pix", "punkt", "bildpunkt", "point"};

/// "lower left": where the first pixel lies anyway.
bool is_lower_left(const Remark& words) {
  constexpr std::array<std::string_view, 7> kLower{"lower",       "left",   "lower-left", "bottom",
                                                   "bottom-left", "corner", "unten"};
  return std::all_of(words.begin(), words.end(),
                     [&](const RemarkWord& word) { return is_among(word.folded, kLower); }) &&
         words.size() <= 2 && words.back().folded != "corner" && words.front().folded != "corner";
}

/// Whether a place other than 0, or a spot of the map, stands behind the word.
bool places_a_spot(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 15> kBetween{"at",  "of", "is", "by", "bei", "um",    "a", "en",
                                                      "von", "x",  "y",  "dx", "dy",  "pixel", "px"};
  constexpr std::array<std::string_view, 12> kSpots{"center", "centre", "middle", "mitte", "corner",   "left",
                                                    "right",  "bottom", "lower",  "ecke",  "centered", "milieu"};
  std::size_t next = at + 1;
  while (next < words.size() && is_among(words[next].folded, kBetween)) ++next;
  if (next >= words.size()) return false;
  const bool origin = words[at].folded.starts_with("ori") || words[at].folded == "ursprung";
  if (origin) {
    const Remark rest(words.begin() + static_cast<std::ptrdiff_t>(next), words.end());
    if (holds_any(rest, kSpots) && !is_lower_left(rest)) return true;
  }
  for (; next < words.size() && words[next].number; ++next) {
    if (number_of(words[next]).value_or(1.0) != 0.0) return true;
  }
  return false;
}

/// The number that a word of an interval begins with: -25 of "-25:0.5:25" and "-25..25".
std::optional<double> first_number_of(const std::string& word) {
  const std::size_t end = std::min(word.find(':'), word.find(".."));
  return finite_number(std::string_view(word).substr(0, end));
}

/// "x from -25 to 25 mm", "x = -25:0.5:25", "-25 < x < 25"; one number alone is no interval.
bool begins_an_interval(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 22> kBetween{
      "from", "to",  "range", "ranges", "in",  "between", "and", "is",   "runs", "axis",  "values",
      "..",   "...", "-",     "von",    "bis", "de",      "a",   "goes", "over", "spans", "mm"};
  if (words[at].folded != "x" && words[at].folded != "y") return false;
  const auto sign = [&](std::size_t i) {
    return i < words.size() && std::string_view("<>=").find(words[i].before) < 3;
  };
  const bool inside = at > 0 && words[at - 1].number && sign(at) && sign(at + 1);
  if (inside) return number_of(words[at - 1]).value_or(0.0) != 0.0;
  if (at > 0 && words[at - 1].number && words[at].before == ' ') return false;  // times
  std::vector<double> numbers;
  for (std::size_t i = at + 1; i < words.size() && numbers.size() < 2; ++i) {
    const bool several = words[i].text.find(':') != std::string::npos || words[i].text.find("..") != std::string::npos;
    const auto number = first_number_of(words[i].text);
    if (number) {
      numbers.insert(numbers.end(), several ? 2 : 1, *number);
    } else if (!is_among(words[i].folded, kBetween) && !known_length_unit(words[i].text)) {
      break;
    }
  }
  if (numbers.size() == 2) return numbers.front() != 0.0;
  constexpr std::array<std::string_view, 9> kStarts{"edge",     "starts",  "start",    "begins", "beginning",
                                                    "starting", "beginnt", "commence", "first"};
  const bool starts = std::any_of(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(at),
                                  [&](const RemarkWord& word) { return is_among(word.folded, kStarts); });
  return starts && numbers.size() == 1 && numbers.front() != 0.0;
}

}  // namespace

/// "pixel indices", "coordinates in pixels", "0.1 mm per pixel", "x and y in inches".
bool speaks_of_places(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 10> kOfPixels{"indices", "index", "indexes",   "coordinates", "coords",
                                                       "numbers", "units", "positions", "koordinaten", "indizes"};
  constexpr std::array<std::string_view, 14> kPlaces{
      "coordinates", "coords", "coordinate", "positions",   "position",    "lateral", "laterals",
      "xy",          "x",      "y",          "koordinaten", "coordonnees", "x,y",     "abszissen"};
  const std::string& word = words[at].folded;
  const bool is_so_long = at + 2 < words.size() && words[at + 1].before == '=' && words[at + 1].number &&
                          known_length_unit(words[at + 2].text);
  if (is_so_long && is_among(word, kPixelNames)) return true;  // "1 px = 0.1 mm"
  const std::size_t slash = word.find('/');
  if (slash != std::string::npos && known_length_unit(word.substr(0, slash)) &&
      is_among(word.substr(slash + 1), kPixelNames))
    return true;
  if (at + 1 < words.size() && word == "per" && at > 0) {
    return known_length_unit(words[at - 1].text) && is_among(words[at + 1].folded, kPixelNames);
  }
  if (at + 1 < words.size() && is_among(word, kPixelNames) && is_among(words[at + 1].folded, kOfPixels)) return true;
  const bool unit = is_among(word, kPixelNames) ||
                    (unit_of_word(words, at) && known_length_unit(word) != std::optional(units::kNmPerMm));
  if (!unit || follows_a_number(words, at) || !is_announced(words, at)) return false;
  const std::size_t begin = clause_of(words, at);
  return std::any_of(words.begin() + static_cast<std::ptrdiff_t>(begin),
                     words.begin() + static_cast<std::ptrdiff_t>(at),
                     [&](const RemarkWord& before) { return is_among(before.folded, kPlaces); });
}

/// "all lengths in m": the coordinates too.
bool speaks_of_all(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 10> kAll{"all",       "lengths", "dimensions", "everything", "length",
                                                  "distances", "alle",    "laengen",    "longueurs",  "toutes"};
  const std::size_t begin = clause_of(words, at);
  return known_length_unit(words[at].text) != std::optional(units::kNmPerMm) && !holds_value_word(words, begin, at) &&
         std::any_of(words.begin() + static_cast<std::ptrdiff_t>(begin),
                     words.begin() + static_cast<std::ptrdiff_t>(at),
                     [&](const RemarkWord& word) { return is_among(word.folded, kAll); });
}

bool speaks_of_an_origin(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 15> kPlaces{"center",   "centre",  "centered", "centred", "mitte",
                                                     "corner",   "extent",  "origin",   "zentrum", "mittelpunkt",
                                                     "ursprung", "origine", "ecke",     "coin",    "origen"};
  return (is_among(words[at].folded, kPlaces) && places_a_spot(words, at)) || begins_an_interval(words, at);
}

bool speaks_of_a_shift(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 8> kShifts{"offset",    "shifted",    "translated", "decentered",
                                                    "decentred", "verschoben", "displaced",  "decale"};
  return is_among(words[at].folded, kShifts) && places_a_spot(words, at);
}

}  // namespace dwell
