#include "core/formats/remark_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/formats/map_terms.h"
#include "core/formats/remark_factors.h"
#include "core/formats/remark_orientation.h"
#include "core/formats/remark_places.h"
#include "core/formats/remark_values.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using About = UnclearStatement::About;

/// "missing pixels set to -9999", "-1 = no data"; not "12 bad pixels".
bool speaks_of_no_data(const Remark& words) {
  constexpr std::array<std::string_view, 25> kMissing{
      "padded",     "padding", "empty",       "dead",   "off-aperture", "default",  "nodata",
      "missing",    "invalid", "undefined",   "masked", "bad",          "dropout",  "dropouts",
      "ungueltig",  "fehlend", "manquant",    "void",   "outside",      "exterior", "background",
      "ausserhalb", "mask",    "hintergrund", "dehors"};
  constexpr std::array<std::string_view, 8> kCounted{"pixels", "points",   "count",       "number",
                                                     "share",  "diameter", "temperature", "radius"};
  constexpr std::array<std::string_view, 15> kSet{"with", "to",   "are",   "is",     "as",    "marked",  "by", "value",
                                                  "set",  "mean", "means", "stands", "coded", "denoted", "="};
  bool missing = holds_any(words, kMissing);
  for (std::size_t i = 1; i < words.size(); ++i) {
    missing =
        missing || (words[i].folded == "data" && (words[i - 1].folded == "no" || words[i - 1].folded == "without"));
  }
  if (!missing) return false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!finite_number(words[i].text)) continue;
    const bool of_unit = i + 1 < words.size() && (known_value_unit(words[i + 1].text) || words[i + 1].text == "%");
    const bool named = words[i].before == ':' && i + 1 == words.size() && !holds_any(words, kCounted);
    const bool said = named || (i > 0 && (is_among(words[i - 1].folded, kSet) || words[i].before == '=')) ||
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
    add(speaks_of_a_shift(words, i), About::Shift, "a place of the map",
        "write '# origin_mm: x,y', the centre of the first pixel");
  }
  add(speaks_of_a_sign(words), About::Factor,
      "a sign of the values; those that are positive are taken for material to remove",
      "turn their sign so and leave the comment out");
  const char* const orientation =
      "an orientation; the first row is taken for that of the smallest y, the first column for that of the smallest x";
  add(speaks_of_rows(words), About::Rows, orientation, "turn the map so and leave the comment out");
  add(speaks_of_axes(words), About::Axes, orientation, "turn the map so and leave the comment out");
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
