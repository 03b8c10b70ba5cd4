#include "core/formats/field_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using Words = std::span<const std::string_view>;

// All without separators and in lower case, without the x or y of an axis.
constexpr std::string_view kClearPitches[] = {
    "pitch",        "pixelpitch", "pixelsize",   "pixsize",       "pxsize",       "pixelspacing",     "spacing",
    "pixelscale",   "pixscale",   "pixelscl",    "puplscal",      "gridspacing",  "gridpitch",        "gridstep",
    "lateralpitch", "step",       "stepsize",    "sampling",      "samplingstep", "samplinginterval", "pointpitch",
    "pointspacing", "pixelwidth", "pixelheight", "samplespacing", "delta",        "mappitch",         "pixelstep"};
constexpr std::string_view kDoubtfulPitches[] = {"resolution",
                                                 "lateralresolution",
                                                 "lateralres",
                                                 "lateralscale",
                                                 "lateralsampling",
                                                 "pix",
                                                 "pixsz",
                                                 "pixelsz",
                                                 "diffelem",
                                                 "elementsize",
                                                 "voxelsize",
                                                 "cellsize",
                                                 "interval",
                                                 "increment",
                                                 "physicalsize",
                                                 "samplinglength",
                                                 "pixelsper",
                                                 "pixelspermm",
                                                 "ppmm",
                                                 "dpi",
                                                 "pltscale",
                                                 "platescl",
                                                 "platescale",
                                                 "secpix",
                                                 "calibration",
                                                 "lateralcalibration"};
constexpr std::string_view kSizes[] = {
    "size",      "width",       "height",   "extent",      "length",       "real",      "diameter",
    "diam",      "radius",      "fov",      "fieldofview", "mapsize",      "imagesize", "scansize",
    "scanrange", "lateralsize", "realsize", "pupldiam",    "aperturesize", "range",     "span"};
constexpr std::string_view kOrigins[] = {"origin", "corner",  "lowerleft", "upperleft", "firstpixel",  "orig",
                                         "org",    "orgsubf", "mapcentre", "mapcenter", "translation", "position"};
constexpr std::string_view kOriginsOfAnAxis[] = {"offset", "off",   "0",      "min",    "start",     "pos",
                                                 "left",   "first", "centre", "center", "lowerbound"};
constexpr std::string_view kNoData[] = {
    "nodata",        "nodatavalue",  "nodataval",      "nodatava",     "fill",     "fillvalue", "fillval",
    "missing",       "missingvalue", "invalid",        "invalidvalue", "bad",      "badvalue",  "badval",
    "badpixelvalue", "nullvalue",    "nullval",        "null",         "nanvalue", "maskvalue", "maskedvalue",
    "blank",         "undefined",    "undefinedvalue", "novalue",      "dummy",    "sentinel"};
constexpr std::string_view kScales[] = {
    "scale",      "scalefactor",  "addoffset",   "zscale",       "zfactor",     "zscalefactor", "zoffset",
    "multiplier", "slope",        "intercept",   "offset",       "zmult",       "heightscale",  "valuescale",
    "datascale",  "heightfactor", "valuefactor", "heightoffset", "valueoffset", "nmpercount",   "nmperlevel"};
constexpr std::string_view kLabels[] = {"longname", "label", "zlabel", "datalabel", "quantity"};
constexpr std::string_view kValues[] = {
    "",    "z",       "b",      "value",    "values",     "val",   "data",    "height",      "heights",
    "h",   "surface", "map",    "vertical", "amplitude",  "phase", "opd",     "wavefront",   "w",
    "sfe", "wfe",     "figure", "error",    "rate",       "rates", "removal", "removalrate", "depth",
    "dz",  "sag",     "array",  "image",    "pixelvalue", "opdmap"};
constexpr std::string_view kLaterals[] = {
    "x",          "y",          "xy",           "lateral",    "pitch",       "pixel",   "pixelsize",
    "spacing",    "spatial",    "horizontal",   "coordinate", "coordinates", "grid",    "origin",
    "pixelscale", "step",       "axis",         "axes",       "position",    "pix",     "length",
    "xyz",        "pixelpitch", "pixelspacing", "size",       "sampling",    "distance"};
constexpr std::string_view kOthers[] = {"time",  "exposure", "temperature", "wavelength", "force",
                                        "speed", "angle",    "frequency",   "pressure",   "power"};
constexpr std::string_view kContexts[] = {"grid",     "map",  "image",  "data",    "meta",       "metadata",
                                          "geometry", "part", "header", "surface", "measurement"};
constexpr std::string_view kCameras[] = {"camera", "detector", "sensor", "ccd", "chip", "cam", "det"};

bool among(std::string_view word, Words words) { return std::find(words.begin(), words.end(), word) != words.end(); }

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || static_cast<signed char>(c) < 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }

/// "Pixel size (um)" and "PixelSize_um" -> pixel, size, um.
std::vector<std::string> name_words(std::string_view name) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool camel =
        i > 0 && is_upper(name[i]) &&
        (is_lower(name[i - 1]) || (is_upper(name[i - 1]) && i + 1 < name.size() && is_lower(name[i + 1])));
    if ((camel || !is_letter(name[i])) && !words.back().empty()) words.emplace_back();
    if (is_letter(name[i])) words.back() += lower_case(name.substr(i, 1));
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool is_pixel(const std::string& word) {
  constexpr std::string_view kPixels[] = {"pixel", "pix", "px", "pixels", "sample", "point", "lateral"};
  return among(word, kPixels);
}

/// The unit of length at the end of the words, or before "per pixel", in mm; takes these words away.
std::optional<double> take_length(std::vector<std::string>& words, bool& per_pixel) {
  const std::size_t count = words.size();
  if (count >= 3 && words[count - 2] == "per" && is_pixel(words.back())) {
    const auto nm = known_length_unit(words[count - 3]);
    if (!nm) return std::nullopt;
    words.resize(count - 3);
    per_pixel = true;
    return *nm / units::kNmPerMm;
  }
  if (count < 2 || words.back() == "in" || words[count - 2] == "per") return std::nullopt;
  const auto nm = known_length_unit(words.back());
  if (!nm) return std::nullopt;
  words.pop_back();
  return *nm / units::kNmPerMm;
}

/// The x or y that stands alone among the words; takes it away.
FieldAxis take_axis(std::vector<std::string>& words) {
  for (const auto& [letter, axis] : {std::pair{"x", FieldAxis::X}, {"y", FieldAxis::Y}}) {
    const auto found = std::find(words.begin(), words.end(), letter);
    if (found == words.end() || words.size() < 2) continue;
    words.erase(found);
    return axis;
  }
  return FieldAxis::Both;
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += word;
  return all;
}

/// Whether any list of topics that have axes knows the word.
bool known_of_an_axis(std::string_view word) {
  return among(word, kClearPitches) || among(word, kDoubtfulPitches) || among(word, kSizes) || among(word, kOrigins) ||
         among(word, kOriginsOfAnAxis) || word == "scale";
}

/// xpix, pitchx, PIXSIZE1 -> the word without its axis.
FieldAxis take_grown_axis(std::string& word) {
  const auto axis_of = [](char c) {
    if (c == 'x' || c == '1') return FieldAxis::X;
    return c == 'y' || c == '2' ? FieldAxis::Y : FieldAxis::Both;
  };
  if (word.size() < 2) return FieldAxis::Both;
  if (const FieldAxis first = axis_of(word.front()); std::isalpha(static_cast<unsigned char>(word.front())) != 0 &&
                                                     first != FieldAxis::Both && known_of_an_axis(word.substr(1))) {
    word.erase(0, 1);
    return first;
  }
  const FieldAxis last = axis_of(word.back());
  if (last == FieldAxis::Both) return last;
  const std::string rest = word.substr(0, word.size() - 1);
  if (rest == "d") {
    word = "delta";
    return last;
  }
  if (!known_of_an_axis(rest)) return FieldAxis::Both;
  word = rest;
  return last;
}

FieldTopic unit_topic(std::string_view of) {
  if (among(of, kValues)) return FieldTopic::ValueUnit;
  if (among(of, kLaterals)) return FieldTopic::LateralUnit;
  const bool other = std::any_of(std::begin(kOthers), std::end(kOthers),
                                 [&](std::string_view word) { return of.find(word) != std::string_view::npos; });
  return other ? FieldTopic::Other : FieldTopic::UnknownUnit;
}

/// The topic of a unit's name, if it is one.
std::optional<FieldTopic> find_unit(const std::vector<std::string>& words) {
  constexpr std::string_view kUnits[] = {"units", "unit", "uom"};
  const std::string all = joined(words);
  for (const std::string_view unit : kUnits) {
    if (all.ends_with(unit)) return unit_topic(std::string_view(all).substr(0, all.size() - unit.size()));
    if (words.front() == unit) return unit_topic(words.back() == unit ? "" : all.substr(unit.size()));
  }
  return std::nullopt;
}

bool take_camera(std::vector<std::string>& words) {
  const auto end = std::remove_if(words.begin(), words.end(), [](const auto& word) { return among(word, kCameras); });
  const bool found = end != words.end() && end != words.begin();
  if (found) words.erase(end, words.end());
  return found;
}

/// Takes words from the front that only say of what: "grid.pixel_size" is a pixel size.
void take_context(std::vector<std::string>& words) {
  while (words.size() > 1 && among(words.front(), kContexts)) words.erase(words.begin());
}

FieldTopic topic_of(std::string_view word, FieldAxis axis) {
  if (among(word, kClearPitches) || among(word, kDoubtfulPitches)) return FieldTopic::Pitch;
  if (word == "scale" && axis != FieldAxis::Both) return FieldTopic::Pitch;
  if (among(word, kSizes)) return FieldTopic::Size;
  if (among(word, kOrigins) || (axis != FieldAxis::Both && among(word, kOriginsOfAnAxis))) return FieldTopic::Origin;
  if (among(word, kNoData)) return FieldTopic::NoData;
  if (among(word, kScales)) return FieldTopic::ValueScale;
  return among(word, kLabels) ? FieldTopic::Label : FieldTopic::Other;
}

}  // namespace

FieldName parse_field_name(std::string_view name) {
  std::vector<std::string> words = name_words(name);
  if (words.empty()) return {};
  FieldName field;
  if (const auto unit = find_unit(words)) {
    field.topic = *unit;
    field.clear = true;
    return field;
  }
  bool per_pixel = false;
  field.mm = take_length(words, per_pixel);
  take_context(words);
  const bool camera = take_camera(words);
  field.axis = take_axis(words);
  std::string word = joined(words);
  if (field.axis == FieldAxis::Both) field.axis = take_grown_axis(word);
  if (word.ends_with("mm") && !field.mm && among(word.substr(0, word.size() - 2), kClearPitches)) {
    word.resize(word.size() - 2);  // PITCHMM
    field.mm = 1.0;
  }
  if (word == "d" && field.axis != FieldAxis::Both) word = "delta";  // dX
  if (word == "pixelwidth") field.axis = FieldAxis::X;
  if (word == "pixelheight") field.axis = FieldAxis::Y;
  field.topic = topic_of(word, field.axis);
  if (per_pixel && field.topic != FieldTopic::ValueScale) field.topic = FieldTopic::Pitch;
  const bool named = among(word, kClearPitches) || word == "origin" || per_pixel;
  field.clear = named && !camera;
  return field;
}

}  // namespace dwell
