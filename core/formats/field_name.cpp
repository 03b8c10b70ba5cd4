#include "core/formats/field_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <string>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/units.h"
#include "core/base/word_list.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::string_view kOthers[] = {"time",  "exposure", "temperature", "wavelength", "force",
                                        "speed", "angle",    "frequency",   "pressure",   "power"};
constexpr std::string_view kContexts[] = {"grid",     "map",  "image",  "data",    "meta",       "metadata",
                                          "geometry", "part", "header", "surface", "measurement"};
constexpr std::string_view kCameras[] = {"camera", "detector", "sensor", "ccd", "chip", "cam", "det"};

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
  return is_among(word, kPixels);
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

/// A unit of angle at the end of a name says nothing more: rotation_deg.
void cut_angle(std::vector<std::string>& words) {
  constexpr std::string_view kAngles[] = {"deg", "degree", "degrees", "rad", "mrad", "grad"};
  if (words.size() > 1 && is_among(words.back(), kAngles)) words.pop_back();
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

/// "counts_to_nm", "dn2nm", "nm_per_volt": a factor from what the file holds to heights. A rate ("mm_per_min") is none.
bool is_conversion(const std::vector<std::string>& words) {
  const std::string& last = words.back();
  const std::size_t two = last.find('2');
  if (two != std::string::npos && two > 0 && known_length_unit(last.substr(two + 1))) return true;
  if (words.size() < 3) return false;
  const std::string &middle = words[words.size() - 2], &before = words[words.size() - 3];
  if (middle == "to") return known_length_unit(last).has_value() && !known_length_unit(before);
  return middle == "per" && known_length_unit(before) && !is_pixel(last) && !known_rate_unit(before + "/" + last);
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += word;
  return all;
}

/// Whether the word says something along an axis.
bool known_of_an_axis(std::string_view word) {
  const MapTerm* const term = find_map_term(word, true);
  return term && (term->topic == MapTopic::Pitch || term->topic == MapTopic::Size || term->topic == MapTopic::Origin ||
                  term->topic == MapTopic::Orientation);
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
  if (!known_of_an_axis(rest)) return FieldAxis::Both;
  word = rest;
  return last;
}

MapTopic unit_topic(std::string_view of) {
  if (is_value_of_unit(of)) return MapTopic::ValueUnit;
  if (is_lateral_of_unit(of)) return MapTopic::LateralUnit;
  const bool other = std::any_of(std::begin(kOthers), std::end(kOthers),
                                 [&](std::string_view word) { return of.find(word) != std::string_view::npos; });
  return other ? MapTopic::Other : MapTopic::UnknownUnit;
}

/// The topic of a unit's name, if it is one.
std::optional<MapTopic> find_unit(const std::vector<std::string>& words) {
  const std::string all = joined(words);
  for (const std::string_view unit : {"units", "unit", "uom", "einheiten", "einheit", "unites", "unite"}) {
    if (all.ends_with(unit)) return unit_topic(std::string_view(all).substr(0, all.size() - unit.size()));
    if (words.front() == unit) return unit_topic(words.back() == unit ? "" : all.substr(unit.size()));
  }
  return std::nullopt;
}

bool take_camera(std::vector<std::string>& words) {
  const auto end =
      std::remove_if(words.begin(), words.end(), [](const auto& word) { return is_among(word, kCameras); });
  const bool found = end != words.end() && end != words.begin();
  if (found) words.erase(end, words.end());
  return found;
}

/// Takes words from the front that only say of what: "grid.pixel_size" is a pixel size.
void take_context(std::vector<std::string>& words) {
  while (words.size() > 1 && is_among(words.front(), kContexts)) words.erase(words.begin());
}

bool is_clear_pitch(std::string_view word) {
  const MapTerm* const term = find_map_term(word, false);
  return term && term->topic == MapTopic::Pitch && term->field == InField::Clear;
}

}  // namespace

FieldName parse_field_name(std::string_view name) {
  std::vector<std::string> words = name_words(name);
  for (std::string& word : words) word = fold_letters(word);
  if (words.empty()) return {};
  FieldName field;
  if (const auto unit = find_unit(words)) {
    field.topic = *unit;
    field.clear = true;
    return field;
  }
  if (is_conversion(words)) {
    field.topic = MapTopic::ValueScale;
    return field;
  }
  bool per_pixel = false;
  field.mm = take_length(words, per_pixel);
  cut_angle(words);
  take_context(words);
  const bool camera = take_camera(words);
  field.axis = take_axis(words);
  std::string word = joined(words);
  field.place = word == "x" || word == "y";
  if (field.axis == FieldAxis::Both) field.axis = take_grown_axis(word);
  if (word.ends_with("mm") && !field.mm && is_clear_pitch(word.substr(0, word.size() - 2))) {
    word.resize(word.size() - 2);  // PITCHMM
    field.mm = 1.0;
  }
  if (word == "pixelwidth") field.axis = FieldAxis::X;
  if (word == "pixelheight") field.axis = FieldAxis::Y;
  const MapTerm* const term = find_map_term(word, field.axis != FieldAxis::Both);
  if (term) field.topic = term->topic;
  if (per_pixel && field.topic != MapTopic::ValueScale) field.topic = MapTopic::Pitch;
  field.middle = word.find("cent") != std::string::npos || word.starts_with("mi");
  field.values = is_value_word(word);
  field.clear = (per_pixel || (term && term->field == InField::Clear)) && !camera;
  return field;
}

}  // namespace dwell
