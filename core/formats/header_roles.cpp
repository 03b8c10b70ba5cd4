#include "core/formats/header_roles.h"

#include <algorithm>
#include <array>

namespace dwell {
namespace {

template <std::size_t n>
bool has_one_of(const HeaderKey& key, const std::array<std::string_view, n>& words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return key.has(word); });
}

/// "zunit" and its like, which hold the axis.
bool is_unit_of_z(std::string_view word) { return word == "zunit" || word == "zunits"; }

/// "unit", "value units", "lateral unit", "unit number".
HeaderMeaning meaning_of_unit(const HeaderKey& key) {
  std::vector<std::string> others;
  for (const std::string& word : key.words) {
    if (!is_unit_name(word) && !is_unit_of_z(word) && word != "de") others.push_back(word);
  }
  const bool lateral = std::any_of(others.begin(), others.end(), [](const std::string& word) {
    return word.size() > 1 && is_lateral_of_unit(word) && !is_value_of_unit(word);
  });
  if (lateral || (others.empty() && (key.axis == 'x' || key.axis == 'y'))) {
    return {MapTopic::LateralUnit, InText::Sure};
  }
  if (others.empty() || are_value_words(others)) return {MapTopic::ValueUnit, InText::Sure};
  std::string joined;
  for (const std::string& word : others) joined += word;
  return is_value_of_unit(joined) ? HeaderMeaning{MapTopic::ValueUnit, InText::Fits}
                                  : HeaderMeaning{MapTopic::UnknownUnit, InText::Doubtful};
}

/// "missing value", "no data marker"; "missing" alone may count pixels. With `loose` no ':' stands behind the name, and
/// a sentence ("no data outside the aperture") may begin so.
HeaderMeaning meaning_of_no_data(const HeaderKey& key, const MapTerm* term) {
  constexpr std::array<std::string_view, 13> kMarks{"missing", "bad",  "invalid", "fill", "null", "void", "undefined",
                                                    "masked",  "mask", "blank",   "na",   "nan",  "no"};
  constexpr std::array<std::string_view, 8> kJoined{"nodata",   "nodatavalue", "fillvalue",  "missingvalue",
                                                    "badvalue", "nullvalue",   "blankvalue", "invalidvalue"};
  constexpr std::array<std::string_view, 5> kCounts{"pixels", "points", "count", "number", "share"};
  if (term && term->topic == MapTopic::NoData) return {MapTopic::NoData, term->text};
  if (has_one_of(key, kCounts)) return {};
  if (has_one_of(key, kJoined)) return {MapTopic::NoData, InText::Sure};
  const bool marks = has_one_of(key, kMarks) && (key.has("value") || key.has("data") || key.has("marker"));
  return marks ? HeaderMeaning{MapTopic::NoData, InText::Sure} : HeaderMeaning{};
}

const MapTerm* find_term(std::string_view stem, char axis) {
  return find_map_term(stem, axis == 'x' || axis == 'y' || axis == 'z');
}

/// Whether a term counts without an axis of its own.
bool fits_axis(const MapTerm* term, char axis) { return term && (axis != 0 || !term->needs_axis); }

/// The term of the key, with its axis if that is part of a word.
const MapTerm* find_term(HeaderKey& key) {
  const std::string_view stem = key.stem;
  if (const MapTerm* term = find_term(stem, key.axis); fits_axis(term, key.axis)) return term;
  if (key.axis != 0 || stem.size() < 2) return nullptr;
  for (const auto& [letter, rest] :
       {std::pair(stem.front(), stem.substr(1)), std::pair(stem.back(), stem.substr(0, stem.size() - 1))}) {
    if (letter != 'x' && letter != 'y' && letter != 'z') continue;
    const MapTerm* term = find_term(rest, letter);
    if (!term || term->topic == MapTopic::NoData || term->topic == MapTopic::Label) continue;
    key.axis = letter;
    return term;
  }
  return nullptr;
}

/// "counts to nm": a factor from what the file holds to heights.
bool is_conversion_key(const HeaderKey& key) {
  return key.words.size() > 1 && key.words.back() == "to" && !key.unit.empty();
}

/// Along z a step, an offset or a sign is one of the values, and an extent says nothing of how they are read.
HeaderMeaning meaning_along_z(const MapTerm& term) {
  const bool offset = term.word == "offset" || term.word == "off";
  if (term.topic == MapTopic::Pitch || term.topic == MapTopic::ValueScale || offset || term.word == "sign") {
    return {MapTopic::ValueScale, InText::Doubtful};
  }
  return {};
}

/// The axis that a width or a height has without saying it.
void take_axis_of_word(HeaderKey& key) {
  if (key.axis != 0) return;
  for (const char* x : {"width", "breite", "largeur"}) {
    if (key.stem.ends_with(x)) key.axis = 'x';
  }
  for (const char* y : {"height", "hoehe", "hauteur"}) {
    if (key.stem.ends_with(y)) key.axis = 'y';
  }
}

/// Words that make a lateral resolution that of the optics, in brackets behind it.
bool is_of_the_optics(const HeaderKey& key) {
  for (const char* word : {"optic", "psf", "airy", "rayleigh", "sparrow", "camera", "detector", "sensor"}) {
    if (key.remark.find(word) != std::string::npos) return true;
  }
  return false;
}

HeaderMeaning meaning_of_term(HeaderKey& key, const MapTerm& term) {
  take_axis_of_word(key);
  if (key.axis == 'z') return meaning_along_z(term);
  if (term.topic == MapTopic::Pitch && is_of_the_optics(key)) return {};
  const bool moves = term.word == "offset" || term.word == "off" || term.word == "lateraloffset";
  if (moves) return {MapTopic::Origin, InText::Doubtful, true};
  if (term.text == InText::Never) return {};
  return {term.topic, term.text};
}

}  // namespace

HeaderMeaning meaning_of(HeaderKey& key) {
  if (key.per_pixel && (key.words.empty() || key.has("scale") || key.has("pixel"))) {
    return {MapTopic::Pitch, InText::Sure};
  }
  if (is_conversion_key(key)) return {MapTopic::ValueScale, InText::Doubtful};
  const bool unit = std::any_of(key.words.begin(), key.words.end(),
                                [](const std::string& word) { return is_unit_name(word) || is_unit_of_z(word); });
  if (unit) return meaning_of_unit(key);
  for (const char* stem : {"xunit", "yunit", "xunits", "yunits"}) {
    if (key.stem == stem) return {MapTopic::LateralUnit, InText::Sure};
  }
  const MapTerm* const term = find_term(key);
  if (const HeaderMeaning no_data = meaning_of_no_data(key, term); no_data.topic != MapTopic::Other) return no_data;
  if (term) return meaning_of_term(key, *term);
  if (key.words.empty() && (key.axis == 'x' || key.axis == 'y')) return {MapTopic::LateralUnit, InText::Fits};
  if (are_value_words(key.words) || (key.words.empty() && key.axis == 'z')) {
    return {MapTopic::ValueUnit, InText::Fits};
  }
  return {};
}

}  // namespace dwell
