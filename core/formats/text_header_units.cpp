#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/formats/header_statements.h"
#include "core/formats/text_header.h"
#include "core/map/value_units.h"

// What comments say of units: the part of TextHeader that takes those of the values, and of x and y.

namespace dwell {
namespace {

using About = UnclearStatement::About;

constexpr const char* kAcceptedUnits = "a unit of height (nm, um, mm, m, waves) or of rate (nm/s, um/s, um/min, m/s)";

/// Whether a name that holds or has a unit is of the heights alone: "height unit", "z", but not "values" or "unit".
bool names_heights(const std::string& shown) {
  constexpr std::array<std::string_view, 9> kAnything{"data",  "value",  "values",  "daten",  "wert",
                                                      "werte", "valeur", "valeurs", "donnees"};
  const HeaderKey key = parse_header_key(shown);
  return key.axis == 'z' || std::any_of(key.words.begin(), key.words.end(), [&](const std::string& word) {
           return is_value_word(word) && !is_among(word, kAnything);
         });
}

}  // namespace

void TextHeader::take_caption(const HeaderKey& key) {
  if (key.axis == 'x' || key.axis == 'y' || speaks_of_coordinates(key)) return take_lateral_unit(key.unit, key.shown);
  if (is_wave_unit(key.remark)) return take_unit(key.remark, key.shown);
  if (is_optical_unit(key.remark)) refuse(key, key.remark, kAcceptedUnits);
  take_unit(key.unit, key.shown);
  if (key.every_axis || speaks_of_everything(key)) take_lateral_unit(key.unit, key.shown);
}

/// "unit um of the surface", "laser unit: um".
bool TextHeader::take_unknown_unit(const HeaderKey& key, std::string_view value) {
  const auto words = words_of(value);
  if (words.empty() || !known_value_unit(words.front())) return false;
  add_unclear(About::Unit, fmt::format("{} looks like the unit of the values; write '# unit: um'",
                                       in_quotes(key.shown + " " + std::string(value))));
  return true;
}

void TextHeader::take_unit(std::string_view unit, const std::string& key) {
  const auto factor = is_wave_unit(unit) ? std::optional(0.0) : known_value_unit(unit);
  if (!factor) throw InputError(fmt::format("{}: {} = '{}'; {} required", place(), key, unit, kAcceptedUnits));
  const bool rate = known_rate_unit(unit).has_value(), rate_before = header_.unit && known_rate_unit(*header_.unit);
  if (header_.unit && (!statements_agree(*factor, *unit_factor_) || rate != rate_before)) {
    throw InputError(fmt::format("{}: {} says '{}', but {} = '{}' above; they must agree", place(), key, unit,
                                 unit_key_, *header_.unit));
  }
  if (header_.unit) return;
  // Over points it may be the unit of x and y too: of m or inches, which heights seldom are in, or of a huge part.
  if (!rate && *factor != units::kNmPerMm && !names_heights(key)) {
    of_everything_ =
        fmt::format("{}: {} in '{}': of x and y too? Name the columns as 'x_mm y_mm z_{}'", place(), key, unit, unit);
  }
  header_.unit = std::string(unit);
  unit_factor_ = factor;
  unit_key_ = key;
}

bool TextHeader::take_value_unit(const HeaderKey& key, std::string_view value, bool sure) {
  if (known_value_unit(value) || is_wave_unit(value)) {
    only_once(key, MapTopic::ValueUnit);
    take_unit(value, key.shown);
    if (key.every_axis || fold_letters(key.shown).starts_with("all")) take_lateral_unit(value, key.shown);
    return true;
  }
  if (sure || is_optical_unit(value) || is_optical_unit(key.remark)) refuse(key, value, kAcceptedUnits);
  return false;
}

void TextHeader::take_lateral_unit(std::string_view unit, const std::string& key) {
  const auto length = known_length_unit(unit);
  if (!length) {
    throw InputError(fmt::format("{}: {} in '{}'; a unit of length (mm, um, m) is required", place(), key, unit));
  }
  if (lateral_ && !statements_agree(*lateral_, *length)) {
    throw InputError(
        fmt::format("{}: {} in '{}', but {} in another unit; they must agree", place(), key, unit, lateral_key_));
  }
  lateral_ = length;
  lateral_key_ = key;
}

bool TextHeader::take_lateral(const HeaderKey& key, std::string_view value, bool sure) {
  if (known_length_unit(value)) {
    take_lateral_unit(value, key.shown);
    return true;
  }
  if (sure) refuse(key, value, "a unit of length (mm, um, m)");
  return false;
}

}  // namespace dwell
