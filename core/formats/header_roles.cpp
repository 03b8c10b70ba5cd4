#include "core/formats/header_roles.h"

#include <algorithm>
#include <array>

namespace dwell {
namespace {

/// A name as programs write it, without case, blanks, axis and unit.
struct HeaderName {
  std::string_view stem;
  HeaderRole role;
  bool sure;
  bool needs_axis = false;  // means it only of an axis: "dx"
};

constexpr std::array kHeaderNames{
    HeaderName{"pitch", HeaderRole::Pitch, true},
    HeaderName{"pixelpitch", HeaderRole::Pitch, true},
    HeaderName{"pixelsize", HeaderRole::Pitch, true},
    HeaderName{"physicalpixelsize", HeaderRole::Pitch, true},
    HeaderName{"pixelspacing", HeaderRole::Pitch, true},
    HeaderName{"pixelscale", HeaderRole::Pitch, true},
    HeaderName{"pixeldistance", HeaderRole::Pitch, true},
    HeaderName{"pixelwidth", HeaderRole::Pitch, true},
    HeaderName{"pixelheight", HeaderRole::Pitch, true},
    HeaderName{"pixel", HeaderRole::Pitch, false},
    HeaderName{"spacing", HeaderRole::Pitch, true},
    HeaderName{"gridspacing", HeaderRole::Pitch, true},
    HeaderName{"gridpitch", HeaderRole::Pitch, true},
    HeaderName{"gridstep", HeaderRole::Pitch, true},
    HeaderName{"cellsize", HeaderRole::Pitch, true},
    HeaderName{"samplespacing", HeaderRole::Pitch, true},
    HeaderName{"samplepitch", HeaderRole::Pitch, true},
    HeaderName{"sampledistance", HeaderRole::Pitch, true},
    HeaderName{"samplingpitch", HeaderRole::Pitch, true},
    HeaderName{"samplingdistance", HeaderRole::Pitch, true},
    HeaderName{"samplinginterval", HeaderRole::Pitch, true},
    HeaderName{"samplingstep", HeaderRole::Pitch, true},
    HeaderName{"stepsize", HeaderRole::Pitch, false},
    HeaderName{"lateralresolution", HeaderRole::Pitch, true},
    HeaderName{"lateralsampling", HeaderRole::Pitch, true},
    HeaderName{"lateralspacing", HeaderRole::Pitch, true},
    HeaderName{"lateralpitch", HeaderRole::Pitch, true},
    HeaderName{"lateralscale", HeaderRole::Pitch, true},
    HeaderName{"camerares", HeaderRole::Pitch, true},
    HeaderName{"cameraresolution", HeaderRole::Pitch, true},
    HeaderName{"platescale", HeaderRole::Pitch, true},
    HeaderName{"physdims", HeaderRole::Pitch, true},
    HeaderName{"d", HeaderRole::Pitch, true, true},
    HeaderName{"delta", HeaderRole::Pitch, true, true},
    HeaderName{"del", HeaderRole::Pitch, true, true},
    HeaderName{"increment", HeaderRole::Pitch, false, true},
    HeaderName{"inc", HeaderRole::Pitch, false, true},
    HeaderName{"step", HeaderRole::Pitch, false},
    HeaderName{"sampling", HeaderRole::Pitch, false},
    HeaderName{"resolution", HeaderRole::Pitch, false},
    HeaderName{"scale", HeaderRole::Pitch, true, true},
    HeaderName{"width", HeaderRole::Size, false},
    HeaderName{"height", HeaderRole::Size, false},
    HeaderName{"size", HeaderRole::Size, false},
    HeaderName{"fieldsize", HeaderRole::Size, false},
    HeaderName{"fieldwidth", HeaderRole::Size, false},
    HeaderName{"fieldheight", HeaderRole::Size, false},
    HeaderName{"realsize", HeaderRole::Size, false},
    HeaderName{"physicalsize", HeaderRole::Size, false},
    HeaderName{"scansize", HeaderRole::Size, false},
    HeaderName{"scanwidth", HeaderRole::Size, false},
    HeaderName{"scanheight", HeaderRole::Size, false},
    HeaderName{"imagesize", HeaderRole::Size, false},
    HeaderName{"imagewidth", HeaderRole::Size, false},
    HeaderName{"imageheight", HeaderRole::Size, false},
    HeaderName{"lateralsize", HeaderRole::Size, false},
    HeaderName{"fieldview", HeaderRole::Size, false},
    HeaderName{"fov", HeaderRole::Size, false},
    HeaderName{"dimension", HeaderRole::Size, false},
    HeaderName{"dimensions", HeaderRole::Size, false},
    HeaderName{"extent", HeaderRole::Size, false},
    HeaderName{"length", HeaderRole::Size, false, true},
    HeaderName{"range", HeaderRole::Size, false, true},
    HeaderName{"real", HeaderRole::Size, false, true},
    HeaderName{"origin", HeaderRole::Origin, true},
    HeaderName{"firstpixel", HeaderRole::Origin, true},
    HeaderName{"lowerleft", HeaderRole::Origin, true},
    HeaderName{"start", HeaderRole::Origin, false, true},
    HeaderName{"min", HeaderRole::Origin, false, true},
    HeaderName{"0", HeaderRole::Origin, true, true},
    HeaderName{"offset", HeaderRole::Offset, false},
    HeaderName{"lateraloffset", HeaderRole::Offset, false},
    HeaderName{"off", HeaderRole::Offset, false, true},
    HeaderName{"scale", HeaderRole::Scale, false},
    HeaderName{"scalefactor", HeaderRole::Scale, false},
    HeaderName{"factor", HeaderRole::Scale, false},
    HeaderName{"multiplier", HeaderRole::Scale, false},
    HeaderName{"heightscale", HeaderRole::Scale, false},
    HeaderName{"valuescale", HeaderRole::Scale, false},
    HeaderName{"datascale", HeaderRole::Scale, false},
    HeaderName{"verticalscale", HeaderRole::Scale, false},
    HeaderName{"heightfactor", HeaderRole::Scale, false},
    HeaderName{"lsb", HeaderRole::Scale, false},
};

template <std::size_t n>
bool has_one_of(const HeaderKey& key, const std::array<std::string_view, n>& words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return key.has(word); });
}

/// "unit", "value units", "lateral unit", "unit number".
HeaderMeaning meaning_of_unit(const HeaderKey& key) {
  std::vector<std::string> others;
  for (const std::string& word : key.words) {
    if (word != "unit" && word != "units" && word != "zunit" && word != "zunits") others.push_back(word);
  }
  constexpr std::array<std::string_view, 10> kLateral{"lateral", "length",  "pitch",    "coordinate", "coordinates",
                                                      "pixel",   "spatial", "position", "grid",       "axis"};
  if (has_one_of(key, kLateral) || (others.empty() && (key.axis == 'x' || key.axis == 'y'))) {
    return {HeaderRole::LateralUnit, true};
  }
  return {HeaderRole::Unit, others.empty() || are_value_words(others)};
}

/// "nodata", "missing value", "fill value"; "missing" alone may count pixels.
HeaderMeaning meaning_of_no_data(const HeaderKey& key) {
  constexpr std::array<std::string_view, 13> kMarks{"missing", "bad",  "invalid", "fill", "null", "void", "undefined",
                                                    "masked",  "mask", "blank",   "na",   "nan",  "no"};
  constexpr std::array<std::string_view, 8> kJoined{"nodata",   "nodatavalue", "fillvalue",  "missingvalue",
                                                    "badvalue", "nullvalue",   "blankvalue", "invalidvalue"};
  constexpr std::array<std::string_view, 5> kCounts{"pixels", "points", "count", "number", "share"};
  if (std::find(kJoined.begin(), kJoined.end(), key.stem) != kJoined.end()) return {HeaderRole::NoData, true};
  if (has_one_of(key, kCounts)) return {};
  if (has_one_of(key, kJoined)) return {HeaderRole::NoData, true};
  if (!has_one_of(key, kMarks)) return {};
  if (key.has("value") || key.has("data") || key.has("marker")) return {HeaderRole::NoData, true};
  const bool alone = key.words.size() == 1 && key.stem != "no" && key.stem != "mask";
  return {alone ? HeaderRole::NoData : HeaderRole::None, false};
}

const HeaderName* find_header_name(std::string_view stem, char axis) {
  const auto* const found = std::find_if(kHeaderNames.begin(), kHeaderNames.end(), [&](const HeaderName& name) {
    return name.stem == stem && (axis == 'x' || axis == 'y' || axis == 'z' || !name.needs_axis);
  });
  return found == kHeaderNames.end() ? nullptr : found;
}

/// The name of the key, with its axis if that is part of a word.
const HeaderName* find_header_name(HeaderKey& key) {
  const std::string_view stem = key.stem;
  if (const HeaderName* name = find_header_name(stem, key.axis)) return name;
  if (key.axis != 0 || stem.size() < 2) return nullptr;
  for (const auto& [letter, rest] :
       {std::pair(stem.front(), stem.substr(1)), std::pair(stem.back(), stem.substr(0, stem.size() - 1))}) {
    if (letter != 'x' && letter != 'y' && letter != 'z') continue;
    if (const HeaderName* name = find_header_name(rest, letter)) {
      key.axis = letter;
      return name;
    }
  }
  return nullptr;
}

/// Along z a step or an offset is one of the values, and an extent says nothing of how they are read.
HeaderMeaning meaning_along_z(const HeaderName& name) {
  if (name.role == HeaderRole::Size || name.stem == "min" || name.stem == "start") return {};
  return {HeaderRole::Scale, false};
}

}  // namespace

HeaderMeaning meaning_of(HeaderKey& key) {
  if (key.per_pixel && (key.words.empty() || key.has("scale") || key.has("pixel"))) return {HeaderRole::Pitch, true};
  for (const char* unit : {"unit", "units", "zunit", "zunits"}) {
    if (key.has(unit)) return meaning_of_unit(key);
  }
  for (const std::string& stem : {std::string("xunit"), std::string("yunit")}) {
    if (key.stem == stem || key.stem == stem + "s") return {HeaderRole::LateralUnit, true};
  }
  if (const HeaderMeaning no_data = meaning_of_no_data(key); no_data.role != HeaderRole::None) return no_data;
  if (const HeaderName* name = find_header_name(key)) {
    if (key.axis == 0 && key.stem.ends_with("width")) key.axis = 'x';
    if (key.axis == 0 && key.stem.ends_with("height")) key.axis = 'y';
    return key.axis == 'z' ? meaning_along_z(*name) : HeaderMeaning{name->role, name->sure};
  }
  if (key.words.empty() && (key.axis == 'x' || key.axis == 'y')) return {HeaderRole::LateralUnit, false};
  if (are_value_words(key.words) || (key.words.empty() && key.axis == 'z')) return {HeaderRole::Unit, false};
  return {};
}

}  // namespace dwell
