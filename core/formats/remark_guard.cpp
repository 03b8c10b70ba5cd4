#include "core/formats/remark_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/map_terms.h"
#include "core/formats/remark_words.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using About = UnclearStatement::About;
using Remark = std::vector<RemarkWord>;

template <std::size_t n>
bool is_known(std::string_view word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

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
constexpr std::array<std::string_view, 7> kPixelNames{"pixel", "pixels", "px", "pix", "punkt", "bildpunkt", "point"};
constexpr std::array<std::string_view, 24> kCounts{
    "count",     "counts",    "lsb", "digit",  "digits",  "level", "levels", "adu",    "bit",    "bits", "grey", "gray",
    "greylevel", "graylevel", "dn",  "fringe", "fringes", "wave",  "waves",  "lambda", "radian", "rad",  "volt", "v"};
constexpr std::array<std::string_view, 14> kWaves{"waves",  "wave",   "wv",       "fringe",  "fringes",
                                                  "lambda", "rad",    "radian",   "radians", "mrad",
                                                  "urad",   "counts", "\xce\xbb", "count"};

bool holds_value_word(const Remark& words, std::size_t from, std::size_t to) {
  return std::any_of(words.begin() + static_cast<std::ptrdiff_t>(from), words.begin() + static_cast<std::ptrdiff_t>(to),
                     [](const RemarkWord& word) { return is_value_word(word.folded) || word.folded == "wavefront"; });
}

/// Where the clause of the word begins.
std::size_t clause_of(const Remark& words, std::size_t at) {
  while (at > 0 && !words[at].clause) --at;
  return at;
}

/// Whether the clause speaks of another quantity, and not of the values.
bool is_of_another_quantity(const Remark& words, std::size_t at) {
  const std::size_t begin = clause_of(words, at);
  if (holds_value_word(words, begin, at)) return false;
  return std::any_of(words.begin() + static_cast<std::ptrdiff_t>(begin),
                     words.begin() + static_cast<std::ptrdiff_t>(at),
                     [](const RemarkWord& word) { return is_known(word.folded, kOtherQuantities); });
}

/// Whether a number with nothing else but the word's name stands behind ':' or '=': "exposure (um): 5".
bool names_a_number(const Remark& words, std::size_t at) {
  const bool valued =
      at + 1 < words.size() && words[at + 1].number && (words[at + 1].before == ':' || words[at + 1].before == '=');
  return valued || (at + 1 < words.size() && words[at].closed && words[at + 1].number);
}

/// Whether the word is the unit of the number before it.
bool follows_a_number(const Remark& words, std::size_t at) {
  if (at == 0 || words[at].before != ' ') return false;
  return words[at - 1].number || is_known(words[at - 1].folded, kNumberWords);
}

/// Whether something before the word announces a unit: "in", a bracket, a comma, ':' or '='.
bool is_announced(const Remark& words, std::size_t at) {
  if (words[at].bracketed() || std::string_view(",:=").find(words[at].before) != std::string_view::npos) return true;
  return at > 0 && (words[at - 1].folded == "in" || words[at - 1].folded == "en" || is_unit_name(words[at - 1].folded));
}

std::optional<double> unit_of_word(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 4> kCommon{"m", "pm", "meter", "metre"};
  const RemarkWord& word = words[at];
  if (word.folded == "in") return std::nullopt;
  if (is_known(word.folded, kCommon) && (!is_announced(words, at) || word.text == "M" || (word.dot && at == 0)))
    return std::nullopt;
  if (const auto unit = known_value_unit(word.text)) return unit;
  // "z/um" and "height_nm" hold their unit.
  const std::size_t sign = word.folded.find_last_of("/_");
  if (sign == std::string::npos || !is_value_word(word.folded.substr(0, sign))) return std::nullopt;
  return known_value_unit(word.folded.substr(sign + 1));
}

bool speaks_of_a_unit(const Remark& words, std::size_t at) {
  return unit_of_word(words, at) && !follows_a_number(words, at) && !names_a_number(words, at) &&
         !is_of_another_quantity(words, at);
}

/// "OPD in waves at 633 nm", but not "0.1 waves" or "fringe projection".
bool speaks_of_waves(const Remark& words, std::size_t at) {
  if (!is_known(words[at].folded, kWaves) || follows_a_number(words, at) || is_of_another_quantity(words, at))
    return false;
  if (names_a_number(words, at)) return false;
  constexpr std::array<std::string_view, 5> kAlsoProse{"wave", "fringe", "count", "counts", "fringes"};
  if (is_known(words[at].folded, kAlsoProse)) return is_announced(words, at) && words[at].before != ',';
  return is_announced(words, at) || holds_value_word(words, clause_of(words, at), at);
}

std::optional<double> number_of(const RemarkWord& word) {
  if (const auto number = finite_number(word.text)) return number;
  std::string pointed = word.text;
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  return finite_number(pointed);
}

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

/// "nm/count", "nm per fringe", "counts per nm".
bool is_per_count(const Remark& words, std::size_t at) {
  const std::string& word = words[at].folded;
  const std::size_t slash = word.find('/');
  if (slash != std::string::npos) {
    const std::string above = word.substr(0, slash), below = word.substr(slash + 1);
    return (known_length_unit(above) && is_known(below, kCounts)) ||
           (is_known(above, kCounts) && known_length_unit(below));
  }
  if (word != "per" || at == 0 || at + 1 == words.size()) return false;
  const std::string &above = words[at - 1].folded, &below = words[at + 1].folded;
  return (known_length_unit(above) && is_known(below, kCounts)) ||
         (is_known(above, kCounts) && known_length_unit(below));
}

/// "gain of 2.5", "scaled by 1000", "x 1e-3", "[10 nm]", "in 1e-9 m" beside a word for the values.
bool is_a_factor(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 22> kVerbs{
      "gain",     "scale",         "factor",    "multiplier", "conversion",  "sensitivity", "scaled",  "multiplied",
      "multiply", "divided",       "divide",    "amplified",  "faktor",      "skaliert",    "facteur", "multiplie",
      "divise",   "multipliziert", "dividiert", "geteilt",    "scalefactor", "lsb"};
  constexpr std::array<std::string_view, 8> kBetween{"by", "of", "is", "mit", "durch", "par", "with", "von"};
  if (is_known(words[at].folded, kVerbs)) {
    std::size_t next = at + 1;
    while (next < words.size() && is_known(words[next].folded, kBetween)) ++next;
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
  const bool in = at > 0 && (words[at - 1].folded == "in" || words[at - 1].folded == "of" || words[at - 1].text == "/");
  if (is_power_of_ten(words[at].text)) return values || in || words[at].bracketed();
  const bool small = known_value_unit(words[at + 1].text).value_or(0.0) < units::kNmPerMm;
  return values && number_of(words[at]).value_or(0.0) != 1.0 &&
         ((words[at].bracketed() && words[at + 1].closed) || (in && small));
}

/// "pixel indices", "coordinates in pixels", "0.1 mm per pixel", "x and y in inches".
bool speaks_of_places(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 10> kOfPixels{"indices", "index", "indexes",   "coordinates", "coords",
                                                       "numbers", "units", "positions", "koordinaten", "indizes"};
  constexpr std::array<std::string_view, 14> kPlaces{
      "coordinates", "coords", "coordinate", "positions",   "position",    "lateral", "laterals",
      "xy",          "x",      "y",          "koordinaten", "coordonnees", "x,y",     "abszissen"};
  const std::string& word = words[at].folded;
  const std::size_t slash = word.find('/');
  if (slash != std::string::npos && known_length_unit(word.substr(0, slash)) &&
      is_known(word.substr(slash + 1), kPixelNames))
    return true;
  if (at + 1 < words.size() && word == "per" && at > 0) {
    return known_length_unit(words[at - 1].text) && is_known(words[at + 1].folded, kPixelNames);
  }
  if (at + 1 < words.size() && is_known(word, kPixelNames) && is_known(words[at + 1].folded, kOfPixels)) return true;
  const bool unit = is_known(word, kPixelNames) ||
                    (unit_of_word(words, at) && known_length_unit(word) != std::optional(units::kNmPerMm));
  if (!unit || follows_a_number(words, at) || !is_announced(words, at)) return false;
  const std::size_t begin = clause_of(words, at);
  return std::any_of(words.begin() + static_cast<std::ptrdiff_t>(begin),
                     words.begin() + static_cast<std::ptrdiff_t>(at),
                     [&](const RemarkWord& before) { return is_known(before.folded, kPlaces); });
}

/// "all lengths in m": the coordinates too.
bool speaks_of_all(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 10> kAll{"all",       "lengths", "dimensions", "everything", "length",
                                                  "distances", "alle",    "laengen",    "longueurs",  "toutes"};
  const std::size_t begin = clause_of(words, at);
  return known_length_unit(words[at].text) != std::optional(units::kNmPerMm) && !holds_value_word(words, begin, at) &&
         std::any_of(words.begin() + static_cast<std::ptrdiff_t>(begin),
                     words.begin() + static_cast<std::ptrdiff_t>(at),
                     [&](const RemarkWord& word) { return is_known(word.folded, kAll); });
}

template <std::size_t n>
bool any_among(const Remark& words, const std::array<std::string_view, n>& known) {
  return std::any_of(words.begin(), words.end(), [&](const RemarkWord& word) { return is_known(word.folded, known); });
}

bool speaks_of_rows(const Remark& words) {
  constexpr std::array<std::string_view, 20> kTurned{"flipped",     "mirrored", "transposed",   "rotated",   "upside",
                                                     "upside-down", "inverted", "gespiegelt",   "gedreht",   "retourne",
                                                     "retournee",   "flipud",   "fliplr",       "reversed",  "top-down",
                                                     "y-down",      "turned",   "transponiert", "transpose", "inverse"};
  constexpr std::array<std::string_view, 22> kRowWords{
      "row",   "rows",   "line",  "lines", "zeile", "zeilen", "ligne",  "lignes",  "y",        "y-axis",  "yaxis",
      "image", "origin", "index", "row0",  "pixel", "first",  "column", "columns", "ursprung", "origine", "upper-left"};
  constexpr std::array<std::string_view, 23> kTop{
      "top",     "upper",    "oben",          "haut",      "down",    "downward",   "downwards",  "topmost",
      "largest", "greatest", "highest",       "top-left",  "topleft", "ymax",       "upper-left", "upperleft",
      "unten",   "bas",      "right-to-left", "groesstes", "max",     "decreasing", "descending"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t next = i + 1 < words.size() && words[i + 1].folded == "by" ? i + 2 : i + 1;
    const bool by_nothing = next < words.size() && finite_number(words[next].text) == std::optional(0.0);
    if (is_known(words[i].folded, kTurned) && !by_nothing) return true;
  }
  return any_among(words, kRowWords) && any_among(words, kTop);
}

/// "centre at 50, 50", "origin: centre", "extent 0 100 0 80".
bool speaks_of_an_origin(const Remark& words, std::size_t at) {
  constexpr std::array<std::string_view, 20> kPlaces{"center",   "centre",  "centered",   "centred",    "mitte",
                                                     "offset",   "shifted", "translated", "decentered", "decentred",
                                                     "corner",   "extent",  "origin",     "zentrum",    "mittelpunkt",
                                                     "ursprung", "origine", "verschoben", "ecke",       "coin"};
  constexpr std::array<std::string_view, 9> kBetween{"at", "of", "is", "by", "bei", "um", "a", "en", "von"};
  constexpr std::array<std::string_view, 12> kSpots{"center", "centre", "middle", "mitte", "corner",   "left",
                                                    "right",  "bottom", "lower",  "ecke",  "centered", "milieu"};
  if (!is_known(words[at].folded, kPlaces)) return false;
  std::size_t next = at + 1;
  while (next < words.size() && is_known(words[next].folded, kBetween)) ++next;
  if (next >= words.size()) return false;
  const bool origin = words[at].folded.starts_with("ori") || words[at].folded == "ursprung";
  if (origin) {
    const Remark rest(words.begin() + static_cast<std::ptrdiff_t>(next), words.end());
    if (any_among(rest, kSpots)) return true;
  }
  for (; next < words.size() && words[next].number; ++next) {
    if (number_of(words[next]).value_or(1.0) != 0.0) return true;
  }
  return false;
}

/// "missing pixels set to -9999", "-1 = no data"; not "12 bad pixels".
bool speaks_of_no_data(const Remark& words) {
  constexpr std::array<std::string_view, 12> kMissing{"nodata",    "missing", "invalid",  "undefined",
                                                      "masked",    "bad",     "dropout",  "dropouts",
                                                      "ungueltig", "fehlend", "manquant", "void"};
  constexpr std::array<std::string_view, 14> kSet{"to",  "are",  "is",    "as",     "marked", "by",      "value",
                                                  "set", "mean", "means", "stands", "coded",  "denoted", "="};
  bool missing = any_among(words, kMissing);
  for (std::size_t i = 1; i < words.size(); ++i) {
    missing =
        missing || (words[i].folded == "data" && (words[i - 1].folded == "no" || words[i - 1].folded == "without"));
  }
  if (!missing) return false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!finite_number(words[i].text)) continue;
    const bool of_unit = i + 1 < words.size() && (known_value_unit(words[i + 1].text) || words[i + 1].text == "%");
    const bool said = (i > 0 && (is_known(words[i - 1].folded, kSet) || words[i].before == '=')) ||
                      (i + 1 < words.size() && (words[i + 1].before == '=' || is_known(words[i + 1].folded, kSet)));
    if (said && !of_unit) return true;
  }
  return false;
}

/// What a statement may speak of, and how it would be clear.
struct Suspicion {
  About about;
  const char *what, *clear_comment;
};

std::vector<Suspicion> suspicions_of(const Remark& words) {
  std::vector<Suspicion> found;
  const auto add = [&](bool is, About about, const char* what, const char* clear_comment) {
    const bool before =
        std::any_of(found.begin(), found.end(), [&](const Suspicion& other) { return other.about == about; });
    if (is && !before) found.push_back({about, what, clear_comment});
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool places = speaks_of_places(words, i), unit = speaks_of_a_unit(words, i);
    add(places, About::Places, "places in another unit than mm",
        "write the pitch as '# pitch_mm: 0.1', or coordinates in mm");
    add(unit && speaks_of_all(words, i), About::Places, "a unit of all lengths",
        "write the pitch as '# pitch_mm: 0.1', or coordinates in mm");
    add(!places && unit, About::Unit, "the unit of the values", "write '# unit: um', or the comment without a unit");
    add(speaks_of_waves(words, i), About::Unit, "a unit of the values that is no length",
        "write the values in a length and '# unit: nm'");
    add(is_per_count(words, i) || is_a_factor(words, i), About::Factor, "a factor of the values",
        "write the values without it and their unit, '# unit: nm'");
    add(speaks_of_an_origin(words, i), About::Origin, "a place of the map",
        "write '# origin_mm: x,y', the centre of the first pixel");
  }
  add(speaks_of_rows(words), About::Rows,
      "an orientation; the first row is taken for that of the smallest y, the first column for that of the smallest x",
      "turn the map so and leave the comment out");
  add(speaks_of_no_data(words), About::NoData, "a value for no data", "write '# nodata: -9999'");
  return found;
}

}  // namespace

std::vector<UnclearStatement> unclear_remarks(std::string_view remark, const std::string& place, RemarkPlace kind) {
  std::vector<UnclearStatement> unclear;
  for (const Suspicion& suspicion : suspicions_of(remark_words(remark))) {
    const char* const way_out = kind == RemarkPlace::Comment
                                    ? suspicion.clear_comment
                                    : "say it under a name of its own, as unit, pitch_mm or origin_mm";
    unclear.push_back({suspicion.about, fmt::format("{}: {} looks like {}; {}", place, in_quotes(trim(remark)),
                                                    suspicion.what, way_out)});
  }
  return unclear;
}

}  // namespace dwell
