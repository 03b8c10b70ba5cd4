#include "core/formats/remark_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/map_terms.h"
#include "core/formats/remark_values.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using About = UnclearStatement::About;

constexpr std::array<std::string_view, 7> kPixelNames{"pixel", "pixels", "px", "pix", "punkt", "bildpunkt", "point"};

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

template <std::size_t n>
bool any_among(const Remark& words, const std::array<std::string_view, n>& known) {
  return std::any_of(words.begin(), words.end(), [&](const RemarkWord& word) { return is_among(word.folded, known); });
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
    if (is_among(words[i].folded, kTurned) && !by_nothing) return true;
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
  if (!is_among(words[at].folded, kPlaces)) return false;
  std::size_t next = at + 1;
  while (next < words.size() && is_among(words[next].folded, kBetween)) ++next;
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
    const bool said = (i > 0 && (is_among(words[i - 1].folded, kSet) || words[i].before == '=')) ||
                      (i + 1 < words.size() && (words[i + 1].before == '=' || is_among(words[i + 1].folded, kSet)));
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
