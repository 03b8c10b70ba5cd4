#include "core/formats/hdf5_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string_view>

#include "core/base/errors.h"
#include "core/base/number_text.h"
#include "core/base/word_list.h"
#include "core/formats/field_name.h"
#include "core/formats/header_statements.h"
#include "core/map/value_units.h"

namespace dwell {
namespace {

/// Read elsewhere: those of CF, of dimension scales, and our own history.
constexpr std::array<std::string_view, 16> kReadElsewhere{
    "scale_factor", "add_offset",         "_FillValue", "missing_value", "valid_min",      "valid_max", "valid_range",
    "_Unsigned",    "DIMENSION_LIST",     "CLASS",      "NAME",          "REFERENCE_LIST", "history",   "coordinates",
    "grid_mapping", "_Netcdf4Coordinates"};

MapField hdf5_field(const std::string& name, const std::optional<Hdf5Value>& value, const std::string& shown) {
  MapField field;
  field.name = name;
  field.shown = shown;
  if (value) field.numbers = value->numbers, field.texts = value->texts, field.logical = value->enumerated;
  return field;
}

/// Small data sets beside the map whose names speak of it, as pitch or unit.
void add_neighbours(const Hdf5File& file, const std::string& path, std::vector<MapField>& fields) {
  for (const std::string& other : file.data_sets_in(group_of(path))) {
    const MapTopic topic = parse_field_name(last_name(other)).topic;
    const bool speaks = topic == MapTopic::ValueUnit || topic == MapTopic::LateralUnit || topic == MapTopic::Pitch ||
                        topic == MapTopic::Origin || topic == MapTopic::NoData || topic == MapTopic::ValueScale ||
                        topic == MapTopic::Orientation || topic == MapTopic::AxisOrder;
    if (!speaks || other == path) continue;
    const auto value = file.table(other);
    if (!value || value->numbers.size() + value->texts.size() > 2) continue;  // an array of its own
    fields.push_back(hdf5_field(last_name(other), value, fmt::format("HDF5 data set '{}'", other)));
  }
}

void add_unit_of_name(const std::string& path, std::vector<MapField>& fields) {
  const std::string unit = unit_of_array_name(last_name(path));
  if (unit.empty()) return;
  MapField field;
  field.name = "unit";
  field.texts = {unit};
  field.shown = fmt::format("the name of HDF5 data set '{}'", path);
  fields.push_back(std::move(field));
}

/// What a group says may hold for all that is in it. Of its many attributes only those count that speak of maps.
std::vector<MapField> fields_of_group(const Hdf5File& file, const std::string& group) {
  std::vector<MapField> fields;
  for (const std::string& name : file.attributes(group)) {
    const FieldName known = parse_field_name(name);
    const std::string lower = lower_case(name);
    const bool of_heights =
        lower.starts_with('z') || lower.find("height") != std::string::npos || lower.find("value") != std::string::npos;
    const bool speaks =
        known.topic == MapTopic::ValueUnit || known.topic == MapTopic::LateralUnit || known.topic == MapTopic::Pitch ||
        known.topic == MapTopic::NoData || (known.topic == MapTopic::Origin && known.clear) ||
        (known.topic == MapTopic::ValueScale && (of_heights || !known.clear)) || known.topic == MapTopic::Orientation ||
        known.topic == MapTopic::AxisOrder || known.topic == MapTopic::Label || known.topic == MapTopic::Other;
    if (!speaks) continue;
    const auto value = file.attribute(group, name);
    // Of what has no topic, a text may still say something.
    const bool elsewhere = is_among(name, kReadElsewhere);
    if (known.topic == MapTopic::Other && (elsewhere || !value || value->texts.empty())) continue;
    fields.push_back(hdf5_field(name, value, fmt::format("attribute {} of HDF5 group '{}'", name, group)));
  }
  return fields;
}

void add_what_is_new(SaidOfMap& said, SaidOfMap more) {
  std::move(more.header.unclear.begin(), more.header.unclear.end(), std::back_inserter(said.header.unclear));
  if (!said.header.unit) said.header.unit = std::move(more.header.unit);
  if (!said.header.wavelength && said.header.wave_field.empty()) {
    said.header.wavelength = more.header.wavelength;
    said.header.wave_field = std::move(more.header.wave_field);
  }
  if (said.header.no_data.empty()) said.header.no_data = std::move(more.header.no_data);
  if (!said.header.pitch) {
    said.header.pitch = more.header.pitch;
    said.pitch_field = std::move(more.pitch_field);
    if (said.unclear_pitch.empty()) said.unclear_pitch = std::move(more.unclear_pitch);
  }
  if (!said.header.origin) {
    said.header.origin = more.header.origin;
    if (said.unclear_origin.empty()) said.unclear_origin = std::move(more.unclear_origin);
  }
}

}  // namespace

std::string group_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos || slash == 0 ? "/" : path.substr(0, slash);
}

std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string unit_of_array_name(const std::string& name) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  const auto begin = std::find_if_not(name.rbegin(), name.rend(), is_word).base();
  std::string unit(begin, name.end());
  if (begin != name.begin() && is_optical_unit(unit))
    return unit;  // heights_waves, phase_rad: refused unless it is known
  if (begin == name.begin() || unit.empty() || !known_length_unit(unit)) return unit_of_label(name);
  std::string before(name.begin(), begin);
  while (!before.empty() && !is_word(before.back())) before.pop_back();
  // One letter, and "in" and "pm", say other things in most names: map_m, zoom_in.
  constexpr std::array<std::string_view, 12> kArrays{"z",   "height", "heights", "opd", "surface", "sag",
                                                     "map", "figure", "error",   "x",   "y",       "data"};
  const bool doubtful = lower_case(unit) == "m" || lower_case(unit) == "in" || lower_case(unit) == "pm";
  const bool array = is_among(lower_case(before), kArrays);
  return doubtful && !array ? "" : unit;
}

std::vector<MapField> fields_of_data_set(const Hdf5File& file, const std::string& path) {
  std::vector<MapField> fields;
  for (const std::string& name : file.attributes(path)) {
    if (is_among(name, kReadElsewhere)) continue;
    fields.push_back(
        hdf5_field(name, file.attribute(path, name), fmt::format("attribute {} of HDF5 data set '{}'", name, path)));
  }
  return fields;
}

SaidOfMap said_of_data_set(const Hdf5File& file, const std::string& path, const std::string& where) {
  std::vector<MapField> fields = fields_of_data_set(file, path);
  add_unit_of_name(path, fields);
  SaidOfMap said = read_map_fields(fields, where);
  std::vector<MapField> neighbours;
  add_neighbours(file, path, neighbours);
  add_what_is_new(said, read_map_fields(neighbours, where));
  for (std::string group = group_of(path);; group = group_of(group)) {
    add_what_is_new(said, read_map_fields(fields_of_group(file, group), where));
    if (group == "/") return said;
  }
}

}  // namespace dwell
